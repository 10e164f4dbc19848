#include "metrics/video_jod.h"

#include "core/error.h"
#include "metrics/cvvdp_metric.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>

namespace {

/// The exponents of Q(v) = Q_0 + b v^k, where Q is pooled_difference() and v the noise's variance. Differences grow as
/// the square root of v where they are seen by themselves, faster where others mask them.
constexpr double least_exponent = 0.5, greatest_exponent = 1.5;

double pooled(const std::vector<VisibleDifferences>& frames) {
    return pooled_difference(frames, cvvdp_channels, false, cvvdp_0_5_6_calibration());
}

double jod_of(double difference) { return jod(std::max(difference, 0.0), cvvdp_0_5_6_calibration()); }

double extended(double at_one, double at_two, double exponent) {
    return at_one - (at_two - at_one) / (std::exp2(exponent) - 1);
}

/// pooled() of `frames` with one band of others.
double with_band_of(std::vector<VisibleDifferences> frames, const std::vector<VisibleDifferences>& others,
                    size_t band) {
    for (size_t f = 0; f < frames.size(); ++f) frames[f][band] = others[f][band];
    return pooled(frames);
}

/// The mean over pixels and channels of the noise's variance over the squared truth, weighted as relmse. `most`: the
/// radiance of the display's peak.
double relative_variance(const VideoJod::Truth& truth, float most) {
    double sum = 0;
    for (size_t i = 0; i < truth.image.values.size(); ++i) {
        const double noise =
            (double(std::min(truth.half_a.values[i], most)) - std::min(truth.half_b.values[i], most)) / 2;
        const double of_value = noise * noise * relative_weight(std::min(truth.image.values[i], most));
        if (std::isfinite(of_value)) sum += of_value;
    }
    return sum / double(truth.image.values.size());
}

}  // namespace

VideoJod::VideoJod(glm::uvec2 extent, const MetricSettings& settings, double frames_per_second)
    : most_radiance_(float(settings.viewing.display.peak / exposed_viewing(settings).nits_per_unit)) {
    try {
        for (int reference = whole; reference <= half_b; ++reference)
            videos_.emplace_back(extent, exposed_viewing(settings), frames_per_second, TemporalPadding::replicate);
    } catch (const Error& reason) {
        videos_.clear();
        note_ = reason.what();
    }
}

void VideoJod::add(const HostImage& test, const Truth& truth, bool is_scored) {
    if (is_scored) pixels_ += test.pixel_count(), undefined_ += count_bad_pixels(test).non_finite();
    if (videos_.empty()) return;
    const HostImage* images[] = {&truth.image, &truth.half_a, &truth.half_b};
    for (size_t reference = 0; reference < videos_.size(); ++reference)
        is_scored ? videos_[reference].add(*images[reference], test)
                  : videos_[reference].add_earlier(*images[reference], test);
    if (!is_scored) return;
    ++scored_;
    noise_variance_ += relative_variance(truth, most_radiance_);
}

TemporalScore VideoJod::score() {
    const TemporalMetric& metric = temporal_metric_named("cvvdp_0_5_6_video");
    TemporalScore row{.metric = &metric,
                      .formula = metric.formula,
                      .mask = "all",
                      .pixels = pixels_ - undefined_,
                      .left_out = undefined_,
                      .note = note_};
    if (!note_.empty()) return row;
    if (scored_ < 2) {
        row.note = "a video has two frames or more";
        return row;
    }
    if (double(undefined_) > most_undefined * double(pixels_)) {
        row.note = "more than 1 % of the pixels are NaN or infinite";
        return row;
    }
    std::vector<std::vector<VisibleDifferences>> frames;
    for (CvvdpVideo& video : videos_) frames.push_back(video.score().frames);
    const double own = pooled(frames[whole]), twice = (pooled(frames[half_a]) + pooled(frames[half_b])) / 2;
    row.value = jod_of(own);
    if (noise_variance_ / double(scored_) > most_noise) return row;

    std::vector<double> changes;
    for (size_t band = 0; band < frames[whole][0].size(); ++band)
        changes.push_back(
            (with_band_of(frames[whole], frames[half_a], band) - with_band_of(frames[whole], frames[half_b], band)) /
            2);
    const double ends[] = {own, extended(own, twice, least_exponent), extended(own, twice, greatest_exponent)};
    const SharedScatter scatter = scatter_of_terms(changes, double(changes.size()));
    const double half_width = student_t_quantile(0.975, scatter.degrees) * std::sqrt(scatter.variance);
    row.high = jod_of(std::ranges::min(ends) - half_width), row.low = jod_of(std::ranges::max(ends) + half_width);
    for (const double change : changes) noise_.push_back(jod_of(own - change) - row.value);
    return row;
}
