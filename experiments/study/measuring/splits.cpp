#include "experiments/study/measuring/splits.h"

#include "metrics/seed_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

const HostImage& half_a(const MetricReference& r) { return r.halves ? r.halves->a : r.image; }
const HostImage& half_b(const MetricReference& r) { return r.halves ? r.halves->b : r.image; }

/// Of (m - A)(m - B), m the mean over the seeds; without halves there is none.
NoisyMap bias_noise(const SeedSplit& split) {
    const MetricReference& reference = split.reference;
    if (!reference.halves) return noisy_map(reference.image.extent, 0);
    HostImage mean(reference.image.extent, 3);
    std::ranges::transform(split.moments.mean, mean.values.begin(), [](double v) { return float(v); });
    return squared_error(mean, *reference.halves, reference.image, [](double) { return 1.0; });
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

void set_intervals(SplitRow& row, std::optional<double> of_noise, bool depends_on_seed) {
    const auto half_width_of = [&](const std::vector<double>& pairs) {
        return depends_on_seed ? half_width_of_successive(pairs, row.seeds) : 0.0;
    };
    const std::optional<double> half_width = half_width_of(row.pairs.variance);
    if (!half_width) return;
    row.variance_low = std::max(0.0, row.variance - *half_width);
    row.variance_high = row.variance + *half_width;
    if (!of_noise) return;
    const double bias_half_width =
        std::hypot(*half_width_of(row.pairs.bias_squared), *of_noise, row.lit_half_width.value_or(0));
    row.bias_squared_low = row.bias_squared - bias_half_width - row.lit_noise.value_or(0);
    row.bias_squared_high = row.bias_squared + bias_half_width;
}

}  // namespace

void SeedSplit::add(unsigned seed, const HostImage& rgb) {
    moments.add(rgb);
    seeds.push_back(seed), images.push_back(rgb);
}

std::vector<SplitRow> split_rows(const SeedSplit& split, std::span<const Mask> masks, const SplitRow& shared,
                                 bool depends_on_seed, const LitNoiseOfErrors& lit_noise) {
    std::vector<SplitRow> rows;
    if (split.images.empty() || (depends_on_seed && split.images.size() < 2)) return rows;
    const std::vector<HostImage> twice(2, split.images.front());
    const std::vector<HostImage>& images = split.images.size() < 2 ? twice : split.images;
    const MetricReference& reference = split.reference;
    const NoisyMap noise = bias_noise(split);
    for (const Mask& mask : masks) {
        const Mask inside = intersection(intersection(mask, split.moments.finite), reference.finite);
        if (inside.count() == 0) continue;
        SplitRow row = shared;
        row.mask = mask.name, row.pixels = inside.count();
        if (const auto of_light = lit_noise_of(lit_noise, {row.target, "mse", row.mask, row.frame}))
            row.lit_noise = of_light->added, row.lit_half_width = of_light->half_width;
        row.seeds = unsigned(split.seeds.size()), row.seed_numbers = split.seeds;
        row.pairs = seed_pairs(images, half_a(reference), half_b(reference), inside);
        row.variance = mean_of(row.pairs.variance), row.bias_squared = mean_of(row.pairs.bias_squared);
        row.mse = row.bias_squared + row.variance;
        std::optional<double> of_noise = noise_half_width(noise, inside);
        if (of_noise) *of_noise /= double(row.pixels);
        set_intervals(row, of_noise, depends_on_seed);
        for (const double sum : group_sums(noise.swapped, inside)) row.reference_noise.push_back(float(sum));
        rows.push_back(std::move(row));
    }
    return rows;
}
