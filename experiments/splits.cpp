#include "experiments/splits.h"

#include "metrics/noise.h"
#include "metrics/pooling.h"

#include <algorithm>
#include <cmath>

namespace {

const HostImage& half_a(const MetricReference& r) { return r.halves ? r.halves->a : r.image; }
const HostImage& half_b(const MetricReference& r) { return r.halves ? r.halves->b : r.image; }

/// Half the change of (m - A)(m - B) when A alone, in place of B, is the reference: see noise_half_width().
Plane swapped_bias(const SeedSplit& split) {
    const HostImage &a = half_a(split.reference), &b = half_b(split.reference);
    Plane swapped(a.extent);
    for (size_t i = 0; i < split.moments.mean.size(); ++i) {
        const double from_a = split.moments.mean[i] - a.values[i], from_b = split.moments.mean[i] - b.values[i];
        swapped.values[i / 3] += (from_a * from_a - from_b * from_b) / 2 / 3;
    }
    return swapped;
}

/// Half the width of Student's interval over the pairs; none below two pairs.
std::optional<double> pair_half_width(const std::vector<Plane>& pairs, const Mask& inside) {
    if (pairs.size() < 2) return {};
    std::vector<double> means;
    for (const Plane& pair : pairs) means.push_back(masked_mean(pair, inside));
    const Estimate estimate = mean_estimate(means);
    return estimate.high - estimate.value;
}

}  // namespace

void SeedSplit::add(const HostImage& rgb) {
    moments.add(rgb);
    if (odd_one.values.empty()) {
        odd_one = rgb;
        return;
    }
    const HostImage &a = half_a(reference), &b = half_b(reference);
    Plane& variance = pair_variances.emplace_back(rgb.extent);
    Plane& bias = pair_biases.emplace_back(rgb.extent);
    for (size_t i = 0; i < rgb.values.size(); ++i) {
        const double x = odd_one.values[i], y = rgb.values[i], ra = a.values[i], rb = b.values[i];
        variance.values[i / 3] += (x - y) * (x - y) / 2 / 3;
        bias.values[i / 3] += ((x - ra) * (y - rb) + (y - ra) * (x - rb)) / 2 / 3;
    }
    odd_one = {};
}

std::vector<SplitRow> split_rows(const SeedSplit& split, std::span<const Mask> masks, const SplitRow& shared) {
    std::vector<SplitRow> rows;
    if (split.moments.count < 2) return rows;
    const MetricReference& reference = split.reference;
    const Plane swapped = swapped_bias(split);
    for (const Mask& mask : masks) {
        const Mask inside = intersection(intersection(mask, split.moments.finite), reference.finite);
        if (inside.count() == 0) continue;
        const ErrorSplit error = split_error(split.moments, reference.image, reference.halves, inside);
        SplitRow row = shared;
        row.mask = mask.name, row.seeds = split.moments.count, row.pixels = inside.count();
        row.mse = error.mse, row.bias_squared = error.bias_squared, row.variance = error.variance;
        if (const std::optional<double> half_width = pair_half_width(split.pair_variances, inside)) {
            row.variance_low = std::max(0.0, row.variance - *half_width);
            row.variance_high = row.variance + *half_width;
            const double bias_half_width =
                std::hypot(*pair_half_width(split.pair_biases, inside), noise_half_width(swapped, inside));
            row.bias_squared_low = row.bias_squared - bias_half_width;
            row.bias_squared_high = row.bias_squared + bias_half_width;
        }
        rows.push_back(std::move(row));
    }
    return rows;
}
