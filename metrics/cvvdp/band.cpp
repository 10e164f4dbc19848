#include "metrics/cvvdp/band.h"

#include "metrics/cvvdp/fast_power.h"
#include "metrics/cvvdp/masking.h"
#include "metrics/cvvdp/pyramid.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {

constexpr float least_background = 0.01f;  // cd/m2
constexpr float greatest_contrast = 1000;  // of positive ones

void background_row(const float* __restrict expanded, float* __restrict background, unsigned width) {
    for (unsigned x = 0; x < width; ++x) background[x] = std::max(expanded[x], least_background);
}

void log2_row(const float* __restrict in, float* __restrict out, unsigned width) {
    for (unsigned x = 0; x < width; ++x) out[x] = fast_log2(in[x]);
}

void contrast_row(const float* __restrict level, const float* __restrict expanded, const float* __restrict background,
                  float scale, float* __restrict out, unsigned width) {
    for (unsigned x = 0; x < width; ++x)
        out[x] = scale * std::min((level[x] - expanded[x]) / background[x], greatest_contrast);
}

void multiply_row(const float* __restrict a, const float* __restrict b, float factor, float* __restrict out,
                  unsigned width) {
    for (unsigned x = 0; x < width; ++x) out[x] = a[x] * (factor * b[x]);
}

void add_squares(const float* __restrict difference, float epsilon, float* __restrict sums, unsigned width) {
    for (unsigned x = 0; x < width; ++x) sums[x] += difference[x] * (difference[x] + 2 * epsilon);
}

/// sums += (v + epsilon)^4 - epsilon^4.
void add_fourth_powers(const float* __restrict difference, float weight, float epsilon, float* __restrict sums,
                       unsigned width) {
    const float e2 = epsilon * epsilon;
    for (unsigned x = 0; x < width; ++x) {
        const float v = weight * difference[x] + epsilon, v2 = v * v;
        sums[x] += (v2 - e2) * (v2 + e2);
    }
}

void fourth_root_row(float* __restrict sums, float epsilon, unsigned width) {
    const float offset = std::sqrt(std::sqrt(epsilon));
    for (unsigned x = 0; x < width; ++x) sums[x] = std::max(std::sqrt(std::sqrt(sums[x] + epsilon)) - offset, 0.0f);
}

void copy_row(const float* row, unsigned y, FloatPlane& plane) { std::copy_n(row, plane.width, plane.row(y)); }

void resize(BandStages& stages, size_t channels, unsigned width, unsigned height) {
    const std::vector<FloatPlane> planes = float_planes(channels, width, height);
    stages.contrast = {planes, planes};
    stages.background = {FloatPlane(width, height), FloatPlane(width, height)};
    stages.sensitivity = stages.mutual_mask = stages.difference = planes;
}

/// Successive rows of a band. The blur of the masks looks at rows around each, so a few are kept in rings.
class Strip {
public:
    Strip(const BandLevels& levels, const Band& band, const CvvdpCalibration& calibration, const Masking& masking,
          const PerCvvdpChannel<double>& map_weights, FloatPlane* map, BandStages* stages)
        : levels_(levels),
          band_(band),
          calibration_(calibration),
          masking_(masking),
          map_weights_(map_weights),
          map_(map),
          stages_(stages),
          channels_(unsigned(levels.test.size())),
          width_(levels.test[0].width),
          height_(levels.test[0].height),
          is_blurred_(std::min(width_, height_) > Masking::blur_radius),
          rings_(width_, 2 * channels_ * ring_rows),
          rows_(width_, 8 + channels_),
          sums_(width_, channels_) {}

    /// Sums over the pixels of rows begin ... end - 1.
    PerCvvdpChannel<double> sums(unsigned begin, unsigned end) {
        const unsigned reach = is_blurred_ ? Masking::blur_radius : 0;
        std::ranges::fill(sums_.values, 0.0f);
        unsigned next = begin - std::min(begin, reach);
        for (unsigned y = begin; y < end; ++y) {
            for (; next < std::min(y + reach + 1, height_); ++next) prepare(next, next >= begin && next < end);
            finish(y);
        }
        PerCvvdpChannel<double> all{};
        for (unsigned c = 0; c < channels_; ++c)
            for (unsigned x = 0; x < width_; ++x) all[c] += sums_.row(c)[x];
        return all;
    }

private:
    static constexpr unsigned ring_rows = 16;  // at least 2 blur_radius + 1; a power of two

    float* difference(unsigned channel, unsigned y) { return rings_.row(channel * ring_rows + y % ring_rows); }
    float* mask(unsigned channel, unsigned y) { return rings_.row((channels_ + channel) * ring_rows + y % ring_rows); }

    /// Fills the rings' row `y`: unmasked differences, and masks that are blurred along the row.
    void prepare(unsigned y, bool is_inside) {
        float* expanded = rows_.row(0);
        float* backgrounds[2] = {rows_.row(1), rows_.row(2)};
        float* first_expanded[2] = {rows_.row(3), rows_.row(4)};
        float* log2_background = rows_.row(5);
        float* sensitivity = rows_.row(6);
        float* contrast = rows_.row(7);
        const std::span<const FloatPlane> level[2] = {levels_.test, levels_.reference};
        const std::span<const FloatPlane> coarser[2] = {levels_.coarser_test, levels_.coarser_reference};
        for (int image = 0; image < 2; ++image) {
            expand_row(coarser[image][0], y, first_expanded[image], width_, scratch_);
            background_row(first_expanded[image], backgrounds[image], width_);
            if (stages_ && is_inside) copy_row(backgrounds[image], y, stages_->background[image]);
        }
        log2_row(backgrounds[1], log2_background, width_);
        for (unsigned c = 0; c < channels_; ++c) {
            band_.sensitivity.row(c, log2_background, sensitivity, width_);
            if (stages_ && is_inside) copy_row(sensitivity, y, stages_->sensitivity[c]);
            float* perceived[2] = {difference(c, y), rows_.row(8 + c)};
            for (int image = 0; image < 2; ++image) {
                if (c > 0) expand_row(coarser[image][c], y, expanded, width_, scratch_);
                contrast_row(level[image][c].row(y), c == 0 ? first_expanded[image] : expanded, backgrounds[image],
                             band_.is_doubled ? 2.0f : 1.0f, contrast, width_);
                if (stages_ && is_inside) copy_row(contrast, y, stages_->contrast[image][c]);
                multiply_row(contrast, sensitivity, float(calibration_.channel_gain[c]), perceived[image], width_);
            }
            Masking::split(perceived[0], perceived[1], width_);
            if (is_blurred_)
                masking_.blur_row(perceived[1], mask(c, y), width_, scratch_);
            else
                std::copy_n(perceived[1], width_, mask(c, y));
        }
    }

    /// Takes row `y` out of the rings.
    void finish(unsigned y) {
        std::array<const float*, cvvdp_channels> masks{};
        for (unsigned c = 0; c < channels_; ++c) {
            float* here = rows_.row(8 + c);
            if (is_blurred_) {
                std::array<const float*, 2 * Masking::blur_radius + 1> around;
                for (unsigned k = 0; k < around.size(); ++k)
                    around[k] = mask(c, reflected(int(y + k) - int(Masking::blur_radius)));
                masking_.blur_column(around, here, width_);
            } else {
                masking_.scale(mask(c, y), here, width_);
            }
            if (stages_) copy_row(here, y, stages_->mutual_mask[c]);
            masking_.raise(c, here, width_);
            masks[c] = here;
        }
        const float epsilon = float(calibration_.epsilon);
        for (unsigned c = 0; c < channels_; ++c) {
            float* seen = difference(c, y);
            masking_.apply(c, std::span(masks).first(channels_), seen, width_);
            add_squares(seen, epsilon, sums_.row(c), width_);
            if (map_) add_fourth_powers(seen, float(map_weights_[c]), epsilon, map_->row(y), width_);
            if (stages_) copy_row(seen, y, stages_->difference[c]);
        }
        if (map_) fourth_root_row(map_->row(y), epsilon, width_);
    }

    /// Row `y` of the image, continued by its mirror image without doubling the edge.
    unsigned reflected(int y) const {
        if (y < 0) return unsigned(-y);
        return unsigned(y) < height_ ? unsigned(y) : 2 * (height_ - 1) - unsigned(y);
    }

    const BandLevels& levels_;
    const Band& band_;
    const CvvdpCalibration& calibration_;
    const Masking& masking_;
    const PerCvvdpChannel<double>& map_weights_;
    FloatPlane* map_;
    BandStages* stages_;
    unsigned channels_, width_, height_;
    bool is_blurred_;
    FloatPlane rings_, rows_, sums_;
    std::vector<float> scratch_;
};

/// The mean of the backgrounds of a whole level.
double mean_background(const FloatPlane& achromatic) {
    double sum = 0;
    for (const float v : achromatic.values) sum += std::max(v, least_background);
    return sum / double(achromatic.values.size());
}

}  // namespace

PerCvvdpChannel<double> band_difference(const BandLevels& levels, const Band& band, const CvvdpCalibration& calibration,
                                        const PerCvvdpChannel<double>& map_weights, FloatPlane* map,
                                        BandStages* stages) {
    const unsigned width = levels.test[0].width, height = levels.test[0].height;
    if (map) std::ranges::fill(map->values, 0.0f);
    if (stages) resize(*stages, levels.test.size(), width, height);
    const Masking masking(calibration);
    // 12 rows of each strip are prepared for its neighbours. Sums over strips must not depend on the number of threads.
    constexpr unsigned strip_rows = 128;
    std::vector<PerCvvdpChannel<double>> sums((height + strip_rows - 1) / strip_rows);
    tbb::enumerable_thread_specific<Strip> strips(
        [&] { return Strip(levels, band, calibration, masking, map_weights, map, stages); });
    tbb::parallel_for(size_t(0), sums.size(), [&](size_t i) {
        const unsigned begin = unsigned(i) * strip_rows;
        sums[i] = strips.local().sums(begin, std::min(begin + strip_rows, height));
    });
    PerCvvdpChannel<double> all{};
    for (const PerCvvdpChannel<double>& of_strip : sums)
        for (unsigned c = 0; c < cvvdp_channels; ++c) all[c] += of_strip[c] / (double(width) * height);
    return all;
}

PerCvvdpChannel<double> base_band_difference(const BandLevels& levels, const Band& band,
                                             const CvvdpCalibration& calibration,
                                             const PerCvvdpChannel<double>& map_weights, FloatPlane* map,
                                             BandStages* stages) {
    const unsigned width = levels.test[0].width, height = levels.test[0].height;
    const unsigned channels = unsigned(levels.test.size());
    if (map) std::ranges::fill(map->values, 0.0f);
    if (stages) {
        resize(*stages, channels, width, height);
        stages->background = {FloatPlane(1, 1), FloatPlane(1, 1)};
        stages->sensitivity.assign(channels, FloatPlane(1, 1));
        stages->mutual_mask.clear();
    }
    const std::span<const FloatPlane> level[2] = {levels.test, levels.reference};
    const float background[2] = {float(mean_background(level[0][0])), float(mean_background(level[1][0]))};
    const float log2_background = std::log2(background[1]);
    const float epsilon = float(calibration.epsilon);
    PerCvvdpChannel<double> all{};
    for (unsigned c = 0; c < channels; ++c) {
        float sensitivity = 0;
        band.sensitivity.row(c, &log2_background, &sensitivity, 1);
        if (stages) stages->sensitivity[c].values[0] = sensitivity;
        FloatPlane difference(width, height);
        for (size_t i = 0; i < difference.values.size(); ++i) {
            float contrast[2];
            for (int image = 0; image < 2; ++image) {
                contrast[image] = std::min(level[image][c].values[i] / background[image], greatest_contrast);
                if (stages) stages->contrast[image][c].values[i] = contrast[image];
            }
            difference.values[i] = std::abs(contrast[0] - contrast[1]) * sensitivity;
            all[c] += double(difference.values[i]) * (difference.values[i] + 2 * calibration.epsilon) /
                      double(difference.values.size());
        }
        if (map)
            add_fourth_powers(difference.values.data(), float(map_weights[c]), epsilon, map->values.data(),
                              unsigned(difference.values.size()));
        if (stages) stages->difference[c] = std::move(difference);
    }
    if (map) fourth_root_row(map->values.data(), epsilon, unsigned(map->values.size()));
    if (stages)
        for (int image = 0; image < 2; ++image) stages->background[image].values[0] = background[image];
    return all;
}
