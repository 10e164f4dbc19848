#include "metrics/noise.h"

#include "metrics/statistics/quantiles.h"
#include "metrics/statistics/summation.h"

#include <algorithm>
#include <cmath>

Plane cross_error(const HostImage& test, const HostImage& half_a, const HostImage& half_b, const HostImage& weighing,
                  double (*weight)(double)) {
    Plane map(test.extent);
    for (size_t i = 0; i < map.values.size(); ++i) {
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double x = test.values[c];
            map.values[i] += weight(weighing.values[c]) * (x - half_a.values[c]) * (x - half_b.values[c]) / 3;
        }
    }
    return map;
}

void SquaredErrorVariance::add(double weight, double error, double variance) {
    const double of_half = 2 * variance;
    linear += weight * std::abs(error) * std::sqrt(of_half);
    product += weight * of_half;
}

NoisyMap noisy_map(glm::uvec2 extent, double samples) {
    return {.error = {}, .swapped = Plane(extent), .variance = Plane(extent), .samples = samples};
}

void add_noise(NoisyMap& sum, const NoisyMap& terms, const Mask& mask) {
    if (sum.is_empty()) sum = noisy_map(terms.swapped.extent, terms.samples);
    sum.samples = std::min(sum.samples, terms.samples);
    sum.is_difference = sum.is_difference || terms.is_difference;
    for (size_t i = 0; i < mask.inside.size(); ++i)
        if (mask.inside[i]) {
            sum.swapped.values[i] += terms.swapped.values[i];
            sum.variance.values[i] += terms.variance.values[i];
        }
}

NoisyMap squared_error(const HostImage& test, const ReferenceHalves& halves, const HostImage& weighing,
                       double (*weight)(double)) {
    NoisyMap terms = noisy_map(test.extent, halves.samples);
    terms.error = cross_error(test, halves.a, halves.b, weighing, weight);
    for (size_t i = 0; i < terms.swapped.values.size(); ++i) {
        SquaredErrorVariance variance;
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double w = weight(weighing.values[c]) / 3;
            const double from_a = double(test.values[c]) - halves.a.values[c];
            const double from_b = double(test.values[c]) - halves.b.values[c];
            terms.swapped.values[i] += w * (from_a * from_a - from_b * from_b) / 2;
            variance.add(w, (from_a + from_b) / 2, halves.variance.values[c]);
        }
        terms.variance.values[i] = variance.value();
    }
    return terms;
}

NoisyMap mean_noise(const ReferenceHalves& halves) {
    NoisyMap terms = noisy_map(halves.a.extent, halves.samples);
    for (size_t i = 0; i < terms.swapped.values.size(); ++i) {
        double deviation = 0;  // as if the channels' noises were one
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            terms.swapped.values[i] += (double(halves.b.values[c]) - halves.a.values[c]) / 2 / 3;
            deviation += std::sqrt(double(halves.variance.values[c])) / 3;
        }
        terms.variance.values[i] = deviation * deviation;
    }
    return terms;
}

std::optional<double> noise_half_width(const NoisyMap& terms, const Mask& mask) {
    const auto sum = [&](const auto& term) {
        return ordered_sum(mask.inside.size(), [&](size_t i) { return mask.inside[i] ? term(i) : 0.0; });
    };
    const std::vector<double>&swapped = terms.swapped.values, &variance = terms.variance.values;
    const double squares = sum([&](size_t i) { return swapped[i] * swapped[i]; });
    if (squares == 0) return 0.0;
    const double total = sum([&](size_t i) { return variance[i]; });
    const double of_squares = sum([&](size_t i) { return variance[i] * variance[i]; });
    const double noisy_pixels = sum([&](size_t i) { return variance[i] > 0 ? 1.0 : 0.0; });
    double degrees = of_squares > 0 ? total * total / of_squares : 0.0;
    if (terms.is_difference)
        degrees = std::min(degrees, squares * squares / sum([&](size_t i) { return std::pow(swapped[i], 4); }));
    const double least_pixels = terms.is_difference ? least_difference_pixels : least_noise_pixels;
    if (degrees < least_pixels || noisy_pixels * terms.samples < least_noise_samples) return std::nullopt;
    return student_t_quantile(0.975, degrees) * std::sqrt(squares);
}
