#include "metrics/flicker.h"

#include "core/error.h"
#include "metrics/tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

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
        if (reference)
            planes.relative.values[p] += relative_weight(reference->weighing_image().values[i]) * variance / 3;
    }
    return planes;
}

// Of the pixel count, then of what the statistic needs. Without one tile, a sum may round to just below 0.
using Totals = std::span<const double>;

double deviation(Totals t) { return std::sqrt(std::max(0.0, t[1]) / t[0]); }
double mean(Totals t) { return t[1] / t[0]; }
double correlation(Totals t) { return 1 - t[2] / (2 * t[1]); }

void set_value(TemporalScore& row, std::span<const std::vector<double>> columns, double (*statistic)(Totals),
               double least, double greatest) {
    row.value = statistic(totals(columns));
    if (const std::optional<double> half_width = jackknife_half_width(columns, statistic)) {
        row.low = std::max(least, row.value - *half_width);
        row.high = std::min(greatest, row.value + *half_width);
    }
}

void withhold(TemporalScore& row, const std::string& why) {
    row.value = NAN;
    row.low = row.high = std::nullopt;
    row.note = why;
}

/// So many that an exponential history of weight a, whose correlation is 1 - a, makes the variance a fifth too small:
/// 2 (1 - a) / (a T) = 0.2.
unsigned frames_needed(double correlation) {
    constexpr double most = 1e6;
    return unsigned(std::clamp(std::ceil(10 * correlation / std::max(1 - correlation, 1e-9)), 0.0, most));
}

Mask finite_pixels(const FlickerMoments& moments, const MetricReference* reference) {
    Mask finite = moments.frames.finite;
    if (!reference) return finite;
    keep_finite(finite, reference->image);
    return intersection(finite, reference->finite);
}

}  // namespace

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
    const Mask finite = finite_pixels(moments, reference);
    const FlickerPlanes planes = flicker_planes(moments, reference, finite);
    std::vector<TemporalScore> scores;
    for (const Mask& mask : masks) {
        const Mask inside = intersection(mask, finite);
        const std::vector<double> counts = tile_counts(inside), variances = tile_sums(planes.variance, inside);
        TemporalScore flicker = empty_score("flicker", mask, finite);
        TemporalScore relative = empty_score("flicker_relative", mask, finite);
        relative.formula = formula_of(*relative.metric, reference && reference->halves);
        TemporalScore lag = empty_score("flicker_correlation", mask, finite);
        if (flicker.pixels > 0) {
            set_value(lag, std::to_array({counts, variances, tile_sums(planes.steps, inside)}), correlation, -1, 1);
            set_value(flicker, std::to_array({counts, variances}), deviation, 0, INFINITY);
            set_value(relative, std::to_array({counts, tile_sums(planes.relative, inside)}), mean, 0, INFINITY);
            if (flicker.value == 0)
                withhold(lag, "nothing flickers");
            else if (const unsigned needed = frames_needed(lag.value); moments.frames.count < needed)
                for (TemporalScore* row : {&flicker, &relative})
                    withhold(*row, std::to_string(moments.frames.count) + " frames are too few where successive ones " +
                                       "are as alike as here: repeat " + std::to_string(needed) + " or more");
        }
        scores.push_back(flicker);
        if (reference) scores.push_back(relative);
        scores.push_back(lag);
    }
    return scores;
}
