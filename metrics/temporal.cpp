#include "metrics/temporal.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "metrics/noise.h"
#include "metrics/pooling.h"
#include "metrics/tiles.h"

#include <algorithm>

namespace {

double relative_weight(double reference) {
    static const auto weight = metric_named("relmse").squared_error_weight;
    return weight(reference);
}

/// What relative errors are weighted by.
const HostImage& weighing(const MetricReference& r) { return r.halves ? r.smooth : r.image; }

bool is_finite(const HostImage& rgb, size_t pixel) {
    const glm::vec3 c = rgb.rgb(pixel);
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

void keep_finite(Mask& mask, const HostImage& rgb) {
    for (size_t i = 0; i < mask.inside.size(); ++i)
        if (!is_finite(rgb, i)) mask.inside[i] = 0;
}

/// Of one pixel, the means over its channels.
struct FlickerPlanes {
    Plane variance, relative, steps;
};

FlickerPlanes flicker_planes(const FlickerMoments& m, const MetricReference* reference, const Mask& finite) {
    const glm::uvec2 extent = m.frames.extent;
    FlickerPlanes planes{Plane(extent), Plane(extent), Plane(extent)};
    for (size_t i = 0; i < m.steps.size(); ++i) {
        const size_t p = i / 3;
        if (!finite.inside[p]) continue;
        const double variance = m.frames.variance(i);
        planes.variance.values[p] += variance / 3;
        planes.steps.values[p] += m.steps[i] / (m.frames.count - 1) / 3;
        if (reference) planes.relative.values[p] += relative_weight(weighing(*reference).values[i]) * variance / 3;
    }
    return planes;
}

using Totals = std::span<const double>;  // of the pixel count, then of what the statistic needs

double deviation(Totals t) { return std::sqrt(t[1] / t[0]); }
double mean(Totals t) { return t[1] / t[0]; }
double correlation(Totals t) { return 1 - t[2] / (2 * t[1]); }

struct Bounds {
    double least, greatest;  ///< of what the statistic can be
};

void estimate(TemporalScore& row, std::span<const std::vector<double>> columns, double (*statistic)(Totals),
              Bounds bounds) {
    row.value = statistic(totals(columns));
    if (const std::optional<double> half_width = jackknife_half_width(columns, statistic)) {
        row.low = std::max(bounds.least, row.value - *half_width);
        row.high = std::min(bounds.greatest, row.value + *half_width);
    }
}

}  // namespace

const std::vector<TemporalMetric>& temporal_metrics() {
    using enum Better;
    static const std::vector<TemporalMetric> table = {
        {"flicker", "temporal_deviation", "radiance", lower,
         "sqrt(mean over pixels and channels of the variance over the frames of a converged shot where nothing moves)"},
        {"flicker_relative", "temporal_variance_a", "1", lower,
         "mean of that variance / (r^2 + 0.01), the weight of relmse"},
        {"flicker_correlation", "temporal_lag_1", "1", near_zero,
         "1 - mean (x_t - x_(t-1))^2 / (2 mean variance over the frames): 0 where frames are independent, towards 1 "
         "where each repeats the last, which buys little flicker by lag"},
        {"frame_difference", "frame_difference_mse", "radiance^2", lower,
         "mean ((x_t - x_(t-1)) - (r_t - r_(t-1)))^2: changes that are not the truth's"},
        {"frame_difference_relative", "frame_difference_a", "1", lower, "that / (r_t^2 + 0.01), the weight of relmse"},
        {"ghost_length", "ghost_projection_0.05", "frames", lower,
         "frames after a change that still hold 5 % of the old image or more: (x_t - plateau) projected onto the "
         "truth's change"},
        {"settling_length", "squared_error_step_0.05", "frames", lower,
         "frames after a change until the squared error is within 5 % of its first step above its plateau"},
    };
    return table;
}

const TemporalMetric& temporal_metric_named(const std::string& name) {
    const auto found = std::ranges::find(temporal_metrics(), name, &TemporalMetric::name);
    if (found != temporal_metrics().end()) return *found;
    std::vector<std::string> names;
    for (const TemporalMetric& metric : temporal_metrics()) names.push_back(metric.name);
    fail("no temporal metric named '", name, "'", suggestion(name, names));
}

void FlickerMoments::add(const HostImage& rgb) {
    frames.add(rgb);
    if (frames.count == 1) steps.assign(rgb.values.size(), 0.0);
    for (size_t i = 0; i < steps.size() && frames.count > 1; ++i) {
        const double step = double(rgb.values[i]) - last.values[i];
        steps[i] += step * step;
    }
    last = rgb;
}

std::vector<TemporalScore> flicker_scores(const FlickerMoments& moments, const MetricReference* reference,
                                          std::span<const Mask> masks) {
    if (moments.frames.count < 2) fail("flicker needs at least two frames, found ", moments.frames.count);
    Mask finite = moments.frames.finite;
    if (reference) {
        if (reference->image.extent != finite.extent) fail("the reference and the frames need images of one size");
        finite = intersection(finite, reference->finite);
        keep_finite(finite, reference->image);
    }
    const FlickerPlanes planes = flicker_planes(moments, reference, finite);
    std::vector<TemporalScore> scores;
    for (const Mask& mask : masks) {
        const Mask inside = intersection(mask, finite);
        const auto columns =
            std::to_array({tile_counts(inside), tile_sums(planes.variance, inside), tile_sums(planes.steps, inside)});
        const auto relative_columns = std::to_array({columns[0], tile_sums(planes.relative, inside)});
        const auto add = [&](const char* name) -> TemporalScore& {
            const size_t pixels = inside.count();
            return scores.emplace_back(TemporalScore{.metric = &temporal_metric_named(name),
                                                     .mask = mask.name,
                                                     .pixels = pixels,
                                                     .left_out = mask.count() - pixels,
                                                     .note = pixels == 0 ? "no finite pixel is inside the mask" : ""});
        };
        if (TemporalScore& row = add("flicker"); row.note.empty()) estimate(row, columns, deviation, {0, INFINITY});
        if (reference)
            if (TemporalScore& row = add("flicker_relative"); row.note.empty())
                estimate(row, relative_columns, mean, {0, INFINITY});
        TemporalScore& row = add("flicker_correlation");
        if (row.note.empty() && totals(columns)[1] == 0) row.note = "nothing flickers";
        if (row.note.empty()) estimate(row, columns, correlation, {-1, 1});
    }
    return scores;
}

namespace {

/// Of one step and each pixel: the squared error of the frame difference without and with the reference's noise, and
/// half its change when the halves are swapped.
struct DifferencePlanes {
    Plane corrected, uncorrected, swapped;
};

double step_of(const HostImage& before, const HostImage& now, size_t i) {
    return double(now.values[i]) - before.values[i];
}

DifferencePlanes difference_planes(const HostImage& test_before, const HostImage& test, const MetricReference& before,
                                   const MetricReference& now, bool is_relative, const Mask& finite) {
    DifferencePlanes planes{Plane(test.extent), Plane(test.extent), Plane(test.extent)};
    const bool has_halves = before.halves && now.halves;
    for (size_t i = 0; i < test.values.size(); ++i) {
        const size_t p = i / 3;
        if (!finite.inside[p]) continue;
        const double weight = (is_relative ? relative_weight(weighing(now).values[i]) : 1.0) / 3;
        const double step = step_of(test_before, test, i), error = step - step_of(before.image, now.image, i);
        planes.uncorrected.values[p] += weight * error * error;
        if (!has_halves) continue;
        const double from_a = step - step_of(before.halves->a, now.halves->a, i);
        const double from_b = step - step_of(before.halves->b, now.halves->b, i);
        planes.corrected.values[p] += weight * from_a * from_b;
        planes.swapped.values[p] += weight * (from_a * from_a - from_b * from_b) / 2;
    }
    return planes;
}

void add_masked(Plane& sum, const Plane& plane, const Mask& mask) {
    for (size_t i = 0; i < plane.values.size(); ++i)
        if (mask.inside[i]) sum.values[i] += plane.values[i];
}

double masked_sum(const Plane& plane, const Mask& mask) {
    return ordered_sum(plane.values.size(), [&](size_t i) { return mask.inside[i] ? plane.values[i] : 0.0; });
}

}  // namespace

void FrameDifference::add(const HostImage& test_before, const HostImage& test, const MetricReference& reference_before,
                          const MetricReference& reference, std::span<const Mask> masks) {
    Mask finite = intersection(reference_before.finite, reference.finite);
    for (const HostImage* image : {&test_before, &test, &reference_before.image, &reference.image}) {
        if (image->extent != finite.extent || image->channels != 3)
            fail("frame differences need images of one size and three channels");
        keep_finite(finite, *image);
    }
    if (sums.empty())
        for (const Mask& mask : masks)
            sums.push_back({.mask = mask.name, .swapped = {Plane(test.extent), Plane(test.extent)}});
    if (!std::ranges::equal(sums, masks, {}, &Sums::mask, &Mask::name))
        fail("frame differences need the same masks at each step");
    has_halves = has_halves && reference_before.halves && reference.halves;
    for (const bool is_relative : {false, true}) {
        const DifferencePlanes planes =
            difference_planes(test_before, test, reference_before, reference, is_relative, finite);
        for (size_t m = 0; m < masks.size(); ++m) {
            const Mask inside = intersection(masks[m], finite);
            sums[m].corrected[is_relative] += masked_sum(planes.corrected, inside);
            sums[m].uncorrected[is_relative] += masked_sum(planes.uncorrected, inside);
            add_masked(sums[m].swapped[is_relative], planes.swapped, inside);
            if (is_relative) continue;
            sums[m].pixels += inside.count();
            sums[m].left_out += masks[m].count() - inside.count();
        }
    }
}

std::vector<TemporalScore> FrameDifference::scores() const {
    std::vector<TemporalScore> scores;
    for (const Sums& s : sums)
        for (const bool is_relative : {false, true}) {
            TemporalScore& row = scores.emplace_back(TemporalScore{
                .metric = &temporal_metric_named(is_relative ? "frame_difference_relative" : "frame_difference"),
                .mask = s.mask,
                .pixels = s.pixels,
                .left_out = s.left_out});
            if (s.pixels == 0) {
                row.note = "no finite pixel is inside the mask";
                continue;
            }
            const double n = double(s.pixels);
            row.uncorrected = s.uncorrected[is_relative] / n;
            row.corrected = has_halves;
            row.value = has_halves ? s.corrected[is_relative] / n : *row.uncorrected;
            if (!has_halves) continue;
            // The halves of all frames are exchanged together, so noise that steps share is counted as it adds up.
            const Plane& swapped = s.swapped[is_relative];
            const double half_width =
                noise_half_width(swapped, full_mask(swapped.extent)) * double(swapped.values.size()) / n;
            row.low = row.value - half_width;
            row.high = row.value + half_width;
        }
    return scores;
}
