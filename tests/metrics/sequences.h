#pragma once
#include "metrics/score.h"

#include <random>

/// What the tests of temporal metrics are made of.
using Random = std::mt19937;

inline HostImage plus_noise(HostImage image, float deviation, Random& random) {
    std::normal_distribution<float> normal(0, deviation);
    for (float& v : image.values) v += normal(random);
    return image;
}

/// A reference whose halves have noise of that deviation each.
inline MetricReference noisy_reference(const HostImage& truth, float deviation, Random& random) {
    ReferenceHalves halves{.a = plus_noise(truth, deviation, random),
                           .b = plus_noise(truth, deviation, random),
                           .variance = HostImage(truth.extent, 3, deviation * deviation / 2),
                           .guide = truth,
                           .samples = 16};
    HostImage mean = truth;
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = (halves.a.values[i] + halves.b.values[i]) / 2;
    return metric_reference(std::move(mean), std::move(halves), {}, {});
}

inline MetricReference exact_reference(const HostImage& truth) { return metric_reference(truth, std::nullopt, {}, {}); }
