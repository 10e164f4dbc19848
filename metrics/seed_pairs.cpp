#include "metrics/seed_pairs.h"

#include "core/error.h"
#include "metrics/metric.h"
#include "metrics/statistics/summation.h"

namespace {

std::vector<size_t> values_inside(const Mask& mask) {
    std::vector<size_t> values;
    for (size_t pixel = 0; pixel < mask.inside.size(); ++pixel)
        for (size_t channel = 0; mask.inside[pixel] && channel < 3; ++channel) values.push_back(3 * pixel + channel);
    return values;
}

double mean_of_pairs(std::span<const double> of_pairs, std::span<const size_t> chosen, size_t left_out) {
    double sum = 0;
    size_t count = 0;
    for (const size_t j : chosen)
        for (const size_t i : chosen) {
            if (i >= j || i == left_out || j == left_out) continue;
            sum += of_pairs[j * (j - 1) / 2 + i];
            ++count;
        }
    return sum / double(count);
}

}  // namespace

SeedPairs seed_pairs(std::span<const HostImage> seeds, const HostImage& half_a, const HostImage& half_b,
                     const Mask& inside) {
    for (const HostImage& seed : seeds)
        if (seed.channels != 3 || seed.extent != inside.extent || half_a.extent != inside.extent ||
            half_b.extent != inside.extent)
            fail("separating bias and variance needs seeds, reference and mask of one size and three channels");
    const std::vector<size_t> values = values_inside(inside);
    const auto mean = [&](const auto& term) {
        return ordered_sum(values.size(), [&](size_t i) { return term(values[i]); }) / double(values.size());
    };
    SeedPairs pairs;
    for (size_t j = 0; j < seeds.size(); ++j)
        for (size_t i = 0; i < j; ++i) {
            const std::vector<float>&x = seeds[i].values, &y = seeds[j].values;
            const std::vector<float>&a = half_a.values, &b = half_b.values;
            pairs.variance.push_back(mean([&](size_t v) {
                const double difference = double(x[v]) - y[v];
                return difference * difference / 2;
            }));
            pairs.bias_squared.push_back(mean([&](size_t v) {
                return ((double(x[v]) - a[v]) * (double(y[v]) - b[v]) + (double(y[v]) - a[v]) * (double(x[v]) - b[v])) /
                       2;
            }));
        }
    return pairs;
}

Jackknifed jackknifed_pairs(std::span<const double> of_pairs, std::span<const size_t> chosen) {
    if (chosen.size() < 2) fail("separating bias and variance needs at least two seeds, found ", chosen.size());
    Jackknifed mean{.value = mean_of_pairs(of_pairs, chosen, size_t(-1)), .without = {}};
    for (size_t i = 0; i < chosen.size() && chosen.size() > 2; ++i)
        mean.without.push_back(mean_of_pairs(of_pairs, chosen, chosen[i]));
    return mean;
}

void SeedMoments::add(const HostImage& rgb) {
    if (count == 0) {
        extent = rgb.extent;
        mean.assign(rgb.pixel_count() * 3, 0.0);
        squares = mean;
        finite = full_mask(extent);
    }
    if (rgb.extent != extent || rgb.channels != 3) fail("all seeds need images of one size and three channels");
    ++count;
    for (size_t i = 0; i < mean.size(); ++i) {
        const double before = rgb.values[i] - mean[i];
        mean[i] += before / count;
        squares[i] += before * (rgb.values[i] - mean[i]);
        if (!std::isfinite(rgb.values[i])) finite.inside[i / 3] = 0;
    }
}
