#include "metrics/video_jod.h"

#include "core/error.h"
#include "metrics/cvvdp_metric.h"
#include "metrics/jod_interval.h"

VideoJod::VideoJod(glm::uvec2 extent, const MetricSettings& settings, double frames_per_second)
    : viewing_(exposed_viewing(settings)) {
    try {
        for (int reference = whole; reference <= half_b; ++reference)
            videos_.emplace_back(extent, viewing_, frames_per_second, TemporalPadding::replicate);
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
    noise_variance_ += relative_noise(truth.half_a, truth.half_b, viewing_);
}

TemporalScore VideoJod::score() {
    const TemporalMetric& metric = temporal_metric_named(video_jod_name);
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
    const DifferenceFrom differences{videos_[whole].score().frames, videos_[half_a].score().frames,
                                     videos_[half_b].score().frames};
    row.value = jod_of(differences.truth, /*is_still=*/false);
    if (noise_variance_ / double(scored_) > most_noise_of_jod) return row;
    JodInterval found = jod_interval(differences, /*is_still=*/false);
    row.low = found.jod.low, row.high = found.jod.high, noise_ = std::move(found.draws);
    return row;
}
