#include "experiments/splits.h"

#include "metrics/pooling.h"

#include <cmath>

void SeedSplit::add(const HostImage& rgb) {
    moments.add(rgb);
    if (odd_one.values.empty()) {
        odd_one = rgb;
        return;
    }
    Plane& variance = pair_variances.emplace_back(rgb.extent);
    for (size_t i = 0; i < rgb.values.size(); ++i) {
        const double difference = double(rgb.values[i]) - odd_one.values[i];
        variance.values[i / 3] += difference * difference / 2 / 3;
    }
    odd_one = {};
}

std::vector<SplitRow> split_rows(const SeedSplit& split, const MetricReference& reference, std::span<const Mask> masks,
                                 const SplitRow& shared) {
    std::vector<SplitRow> rows;
    if (split.moments.count < 2) return rows;
    for (const Mask& mask : masks) {
        const Mask inside = intersection(intersection(mask, split.moments.finite), reference.finite);
        if (inside.count() == 0) continue;
        const ErrorSplit error = split_error(split.moments, reference.image, reference.halves, inside);
        SplitRow row = shared;
        row.mask = mask.name, row.seeds = split.moments.count, row.pixels = inside.count();
        row.mse = error.mse, row.bias_squared = error.bias_squared, row.variance = error.variance;
        std::vector<double> pairs;
        for (const Plane& variance : split.pair_variances) pairs.push_back(masked_mean(variance, inside));
        if (pairs.size() >= 2) {
            const Estimate estimate = mean_estimate(pairs);
            const double half_width = estimate.high - estimate.value;
            row.variance_low = std::max(0.0, row.variance - half_width), row.variance_high = row.variance + half_width;
        }
        rows.push_back(std::move(row));
    }
    return rows;
}
