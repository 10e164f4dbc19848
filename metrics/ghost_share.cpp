#include "metrics/ghost_share.h"

#include "core/error.h"
#include "metrics/pooling.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double least_change_in_noise = 4;  // half-widths, as ghosts after a step have it

void mix_in(HostImage& earlier, const HostImage& image) {
    if (earlier.values.empty()) {
        earlier = image;
        return;
    }
    for (size_t i = 0; i < earlier.values.size(); ++i)
        earlier.values[i] += GhostShare::new_frame * (image.values[i] - earlier.values[i]);
}

struct SharePlanes {
    NoisyMap remaining, change;
};

/// One reference, or one half, with the image of the earlier ones.
struct Side {
    const HostImage &earlier, &now;
    double change(size_t i) const { return double(earlier.values[i]) - now.values[i]; }
    double error(const HostImage& test, size_t i) const { return double(test.values[i]) - now.values[i]; }
};

SharePlanes share_planes(const HostImage& test, const Side& a, const Side& b, const HostImage* variance, double samples,
                         const Mask& finite) {
    SharePlanes planes{noisy_map(test.extent, samples), noisy_map(test.extent, samples)};
    for (NoisyMap* map : {&planes.remaining, &planes.change})
        map->error = Plane(test.extent), map->is_difference = true;
    for (size_t p = 0; p < finite.inside.size(); ++p) {
        if (!finite.inside[p]) continue;
        SquaredErrorVariance of_change, of_remaining;
        for (size_t i = 3 * p; i < 3 * p + 3; ++i) {
            const double error_a = a.error(test, i), error_b = b.error(test, i);
            const double change_a = a.change(i), change_b = b.change(i);
            planes.remaining.error.values[p] += (error_a * change_b + error_b * change_a) / 2 / 3;
            planes.remaining.swapped.values[p] += (error_a * change_a - error_b * change_b) / 2 / 3;
            planes.change.error.values[p] += change_a * change_b / 3;
            planes.change.swapped.values[p] += (change_a * change_a - change_b * change_b) / 2 / 3;
            if (!variance) continue;
            of_change.add(1.0 / 3, (change_a + change_b) / 2, 2.0 * variance->values[i]);  // of two images, at most
            of_remaining.add(1.0 / 3, (change_a + change_b + error_a + error_b) / 2, variance->values[i]);
        }
        planes.change.variance.values[p] = of_change.value();
        planes.remaining.variance.values[p] = of_remaining.value();
    }
    return planes;
}

/// 1.96 standard errors of the sum. The few pixels at edges that change most carry most of it, for which
/// noise_half_width() states no interval; here it only tells a change from none.
double normal_half_width(const NoisyMap& noise) {
    const std::vector<double>& s = noise.swapped.values;
    return 1.96 * std::sqrt(ordered_sum(s.size(), [&](size_t i) { return s[i] * s[i]; }));
}

}  // namespace

void GhostShare::add(const HostImage& test, const MetricReference& before, const MetricReference& now,
                     std::span<const Mask> masks) {
    Mask finite = intersection(before.finite, now.finite);
    for (const HostImage* image : {&test, &before.image, &now.image}) keep_finite(finite, *image);
    has_halves = has_halves && before.halves && now.halves;
    mix_in(earlier_, before.image);
    if (has_halves) mix_in(earlier_a_, before.halves->a), mix_in(earlier_b_, before.halves->b);
    for (size_t i = 0; i < earlier_.values.size(); ++i)
        if (!std::isfinite(earlier_.values[i])) finite.inside[i / 3] = 0;
    if (sums.empty())
        for (const Mask& mask : masks) sums.push_back({.mask = mask.name});
    if (!std::ranges::equal(sums, masks, {}, &Sums::mask, &Mask::name))
        fail("shares of ghosts need the same masks at each step");
    const Side whole{earlier_, now.image};
    const Side a = has_halves ? Side{earlier_a_, now.halves->a} : whole,
               b = has_halves ? Side{earlier_b_, now.halves->b} : whole;
    const SharePlanes planes =
        share_planes(test, a, b, has_halves ? &now.halves->variance : nullptr,
                     has_halves ? std::min(before.halves->samples, now.halves->samples) : 0, finite);
    for (size_t m = 0; m < masks.size(); ++m) {
        const Mask inside = intersection(masks[m], finite);
        sums[m].remaining += masked_sum(planes.remaining.error, inside);
        sums[m].change += masked_sum(planes.change.error, inside);
        add_noise(sums[m].remaining_noise, planes.remaining, inside);
        add_noise(sums[m].change_noise, planes.change, inside);
        sums[m].pixels += inside.count();
        sums[m].left_out += masks[m].count() - inside.count();
    }
}

NoisyMap GhostShare::Sums::noise() const {
    const double share = remaining / change;
    NoisyMap noise = remaining_noise;
    for (size_t i = 0; i < noise.swapped.values.size(); ++i) {
        noise.swapped.values[i] -= share * change_noise.swapped.values[i];
        noise.variance.values[i] += share * share * change_noise.variance.values[i];
    }
    return noise;
}

std::vector<TemporalScore> GhostShare::scores() const {
    std::vector<TemporalScore> scores;
    const TemporalMetric& metric = temporal_metric_named("ghost_share");
    for (const Sums& s : sums) {
        if (s.pixels > 0 && s.change == 0) continue;  // nothing could remain
        TemporalScore& row = scores.emplace_back(TemporalScore{.metric = &metric,
                                                               .formula = metric.formula,
                                                               .mask = s.mask,
                                                               .corrected = has_halves,
                                                               .pixels = s.pixels,
                                                               .left_out = s.left_out});
        if (s.pixels == 0) {
            row.note = no_pixel;
            continue;
        }
        if (has_halves && !(s.change > least_change_in_noise * normal_half_width(s.change_noise))) {
            row.note = "the change is not distinguishable from the noise of the reference";
            continue;
        }
        row.value = s.remaining / s.change;
        if (!has_halves) continue;
        const NoisyMap noise = s.noise();
        if (const auto half_width = noise_half_width(noise, full_mask(noise.swapped.extent)))
            row.low = row.value - *half_width / s.change, row.high = row.value + *half_width / s.change;
    }
    return scores;
}
