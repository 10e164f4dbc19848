#include "metrics/frame_difference.h"

#include "core/error.h"
#include "metrics/noise.h"
#include "metrics/pooling.h"

#include <algorithm>

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
        const double weight = (is_relative ? relative_weight(weighing_image(now).values[i]) : 1.0) / 3;
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
    for (const HostImage* image : {&test_before, &test, &reference_before.image, &reference.image})
        keep_finite(finite, *image);
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
            const TemporalMetric& metric =
                temporal_metric_named(is_relative ? "frame_difference_relative" : "frame_difference");
            TemporalScore& row = scores.emplace_back(
                TemporalScore{.metric = &metric, .mask = s.mask, .pixels = s.pixels, .left_out = s.left_out});
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
            const Plane& swapped = s.swapped[is_relative];
            const double half_width =
                noise_half_width(swapped, full_mask(swapped.extent)) * double(swapped.values.size()) / n;
            row.low = row.value - half_width;
            row.high = row.value + half_width;
        }
    return scores;
}
