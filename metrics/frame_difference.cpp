#include "metrics/frame_difference.h"

#include "core/error.h"
#include "metrics/pooling.h"

#include <algorithm>

namespace {

/// Of one step and each pixel: the squared error of the frame difference without and with the reference's noise.
struct DifferencePlanes {
    NoisyMap corrected;
    Plane uncorrected;
};

double step_of(const HostImage& before, const HostImage& now, size_t i) {
    return double(now.values[i]) - before.values[i];
}

DifferencePlanes difference_planes(const HostImage& test_before, const HostImage& test, const MetricReference& before,
                                   const MetricReference& now, bool is_relative, const Mask& finite) {
    const bool has_halves = before.halves && now.halves;
    const double samples = has_halves ? std::min(before.halves->samples, now.halves->samples) : 0;
    DifferencePlanes planes{noisy_map(test.extent, samples), Plane(test.extent)};
    planes.corrected.error = planes.uncorrected;
    planes.corrected.is_difference = true;
    for (size_t p = 0; p < finite.inside.size(); ++p) {
        if (!finite.inside[p]) continue;
        SquaredErrorVariance variance;
        for (size_t i = 3 * p; i < 3 * p + 3; ++i) {
            const double weight = (is_relative ? relative_weight(now.weighing_image().values[i]) : 1.0) / 3;
            const double step = step_of(test_before, test, i), error = step - step_of(before.image, now.image, i);
            planes.uncorrected.values[p] += weight * error * error;
            if (!has_halves) continue;
            const double step_a = step_of(before.halves->a, now.halves->a, i);
            const double step_b = step_of(before.halves->b, now.halves->b, i);
            const double from_a = step - step_a, from_b = step - step_b;
            planes.corrected.error.values[p] += weight * from_a * from_b;
            planes.corrected.swapped.values[p] += weight * (from_a * from_a - from_b * from_b) / 2;
            variance.add(weight, error, double(before.halves->variance.values[i]) + now.halves->variance.values[i]);
        }
        planes.corrected.variance.values[p] = variance.value();
    }
    return planes;
}

}  // namespace

void FrameDifference::add(const HostImage& test_before, const HostImage& test, const MetricReference& reference_before,
                          const MetricReference& reference, std::span<const Mask> masks) {
    Mask finite = intersection(reference_before.finite, reference.finite);
    for (const HostImage* image : {&test_before, &test, &reference_before.image, &reference.image})
        keep_finite(finite, *image);
    if (sums.empty())
        for (const Mask& mask : masks) sums.push_back({.mask = mask.name});
    if (!std::ranges::equal(sums, masks, {}, &Sums::mask, &Mask::name))
        fail("frame differences need the same masks at each step");
    has_halves = has_halves && reference_before.halves && reference.halves;
    for (const bool is_relative : {false, true}) {
        const DifferencePlanes planes =
            difference_planes(test_before, test, reference_before, reference, is_relative, finite);
        for (size_t m = 0; m < masks.size(); ++m) {
            const Mask inside = intersection(masks[m], finite);
            sums[m].corrected[is_relative] += masked_sum(planes.corrected.error, inside);
            sums[m].uncorrected[is_relative] += masked_sum(planes.uncorrected, inside);
            add_noise(sums[m].noise[is_relative], planes.corrected, inside);
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
            const TemporalMetric& metric =
                temporal_metric_named(is_relative ? "frame_difference_relative" : "frame_difference");
            TemporalScore& row = scores.emplace_back(TemporalScore{.metric = &metric,
                                                                   .formula = formula_of(metric, has_halves),
                                                                   .mask = s.mask,
                                                                   .pixels = s.pixels,
                                                                   .left_out = s.left_out});
            if (s.pixels == 0) {
                row.note = no_pixel;
                continue;
            }
            const double n = double(s.pixels);
            row.uncorrected = s.uncorrected[is_relative] / n;
            row.corrected = has_halves;
            row.value = has_halves ? s.corrected[is_relative] / n : *row.uncorrected;
            if (!has_halves) continue;
            // The halves of all frames are exchanged together, so noise that steps share is counted as it adds up.
            const NoisyMap& noise = s.noise[is_relative];
            const std::optional<double> half_width = noise_half_width(noise, full_mask(noise.swapped.extent));
            if (!half_width) continue;
            row.low = row.value - *half_width / n;
            row.high = row.value + *half_width / n;
        }
    return scores;
}
