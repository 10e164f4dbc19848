#include "experiments/splits.h"

#include "metrics/noise.h"
#include "metrics/seed_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Half the width of Student's interval over the pairs of seeds 0 and 1, 2 and 3 and so on; none below two pairs.
std::optional<double> half_width_of_successive(const std::vector<double>& pairs, size_t seeds) {
    std::vector<double> successive;
    for (size_t j = 1; j < seeds; j += 2) successive.push_back(pairs[j * (j - 1) / 2 + j - 1]);
    if (successive.size() < 2) return {};
    const Estimate estimate = mean_estimate(successive);
    return estimate.high - estimate.value;
}

double mean_of(const std::vector<double>& pairs) {
    return std::accumulate(pairs.begin(), pairs.end(), 0.0) / double(pairs.size());
}

void set_intervals(SplitRow& row, double noise_half_width, bool depends_on_seed) {
    const auto half_width_of = [&](const std::vector<double>& pairs) {
        return depends_on_seed ? half_width_of_successive(pairs, row.seeds) : 0.0;
    };
    const std::optional<double> half_width = half_width_of(row.pairs.variance);
    if (!half_width) return;
    row.variance_low = std::max(0.0, row.variance - *half_width);
    row.variance_high = row.variance + *half_width;
    const double bias_half_width = std::hypot(*half_width_of(row.pairs.bias_squared), noise_half_width);
    row.bias_squared_low = row.bias_squared - bias_half_width;
    row.bias_squared_high = row.bias_squared + bias_half_width;
}

}  // namespace

void SeedSplit::add(unsigned seed, const HostImage& rgb) {
    moments.add(rgb);
    seeds.push_back(seed), images.push_back(rgb);
}

std::vector<SplitRow> split_rows(const SeedSplit& split, std::span<const Mask> masks, const SplitRow& shared,
                                 bool depends_on_seed) {
    std::vector<SplitRow> rows;
    if (split.images.empty() || (depends_on_seed && split.images.size() < 2)) return rows;
    const std::vector<HostImage> twice(2, split.images.front());
    const std::vector<HostImage>& images = split.images.size() < 2 ? twice : split.images;
    const MetricReference& reference = split.reference;
    const Plane swapped = swapped_bias(split);
    for (const Mask& mask : masks) {
        const Mask inside = intersection(intersection(mask, split.moments.finite), reference.finite);
        if (inside.count() == 0) continue;
        SplitRow row = shared;
        row.mask = mask.name, row.pixels = inside.count();
        row.seeds = unsigned(split.seeds.size()), row.seed_numbers = split.seeds;
        row.pairs = seed_pairs(images, half_a(reference), half_b(reference), inside);
        row.variance = mean_of(row.pairs.variance), row.bias_squared = mean_of(row.pairs.bias_squared);
        row.mse = row.bias_squared + row.variance;
        set_intervals(row, noise_half_width(swapped, inside), depends_on_seed);
        for (const double sum : group_sums(swapped, inside)) row.reference_noise.push_back(float(sum));
        rows.push_back(std::move(row));
    }
    return rows;
}
