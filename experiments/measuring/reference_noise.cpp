#include "experiments/measuring/reference_noise.h"

#include "metrics/noise.h"
#include "metrics/pooling.h"

#include <cmath>

namespace {

/// splitmix64 (Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom Number Generators"): neighbours fall into groups
/// that have nothing to do with each other.
size_t group_of(size_t pixel) {
    uint64_t z = (pixel + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return size_t((z ^ (z >> 31)) % noise_groups);
}

}  // namespace

std::vector<double> group_sums(const Plane& plane, const Mask& mask) {
    std::vector<double> sums(noise_groups);
    size_t count = 0;
    for (size_t i = 0; i < plane.values.size(); ++i) {
        if (!mask.inside[i] || !std::isfinite(plane.values[i])) continue;
        sums[group_of(i)] += plane.values[i];
        ++count;
    }
    for (double& sum : sums) sum /= double(std::max<size_t>(count, 1));
    return sums;
}

Plane swapped_error(const Metric& metric, const MetricReference& reference, const HostImage& test) {
    return squared_error_noise(test, *reference.halves, reference.halves->guide, metric.squared_error_weight).swapped;
}

void ReferenceNoiseMeans::add(const std::string& frame, const std::string& target, const MetricReference& reference,
                              const HostImage& test, std::span<const Mask> masks) {
    if (!reference.halves) return;
    for (const Metric* metric : reference.metrics) {
        if (!metric->squared_error_weight) continue;
        const bool is_root = metric->name == "rmse";
        const Plane swapped = swapped_error(*metric, reference, test);
        Plane error;
        if (is_root)
            error = cross_error(test, reference.halves->a, reference.halves->b, reference.halves->guide,
                                metric->squared_error_weight);
        for (const Mask& mask : masks) {
            const Mask inside = intersection(mask, reference.finite);
            if (inside.count() == 0) continue;
            const double slope = is_root ? 0.5 / std::sqrt(masked_mean(error, inside)) : 1.0;
            if (!std::isfinite(slope)) continue;
            const std::vector<double> groups = group_sums(swapped, inside);
            Sum& sum = sums_[{target, metric->name, mask.name, frame}];
            for (size_t g = 0; g < noise_groups; ++g) sum.groups[g] += slope * groups[g];
            ++sum.count;
        }
    }
}

std::vector<ReferenceNoise> ReferenceNoiseMeans::means(const ReferenceNoise& shared) const {
    std::vector<ReferenceNoise> all;
    for (const auto& [key, sum] : sums_) {
        const auto& [target, metric, mask, frame] = key;
        if (frame != over_frames && sums_.contains({target, metric, mask, over_frames})) continue;
        ReferenceNoise noise = shared;
        noise.frame = frame, noise.target = target, noise.metric = metric, noise.mask = mask;
        for (const double group : sum.groups) noise.sums.push_back(float(group / double(sum.count)));
        all.push_back(std::move(noise));
    }
    return all;
}
