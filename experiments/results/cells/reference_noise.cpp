#include "experiments/results/cells/reference_noise.h"

#include "metrics/noise.h"
#include "metrics/temporal.h"

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
        const Plane swapped = swapped_error(*metric, reference, test);
        for (const Mask& mask : masks) {
            const Mask inside = intersection(mask, reference.finite);
            if (inside.count() == 0) continue;
            Sum& sum = sums_[{target, metric->name, mask.name, frame}];
            sum.groups.resize(noise_groups);
            const std::vector<double> groups = group_sums(swapped, inside);
            for (size_t g = 0; g < noise_groups; ++g) sum.groups[g] += groups[g];
            ++sum.count;
        }
    }
}

void ReferenceNoiseMeans::add(const std::string& frame, const std::string& target, const std::string& metric,
                              const std::string& mask, const NoiseGrowth& growth) {
    // No ratio of two counts of outliers was simulated, and the intervals of ratios of mean absolute differences did
    // not cover (metrics/README.md): such effects have no interval.
    if (growth.empty() || !is_error(metric) || metric == "outliers" || metric == "mae") return;
    Sum& sum = sums_[{target, metric, mask, frame}];
    sum.groups.resize(growth.size()), sum.is_growth = true;
    for (size_t i = 0; i < growth.size(); ++i) sum.groups[i] += growth[i];
    ++sum.count;
}

std::vector<ReferenceNoise> ReferenceNoiseMeans::means(const ReferenceNoise& shared) const {
    std::vector<ReferenceNoise> all;
    for (const auto& [key, sum] : sums_) {
        const auto& [target, metric, mask, frame] = key;
        if (frame != over_frames && sums_.contains({target, metric, mask, over_frames})) continue;
        ReferenceNoise noise = shared;
        noise.frame = frame, noise.target = target, noise.metric = metric, noise.mask = mask;
        std::vector<float>& means = sum.is_growth ? noise.growth : noise.sums;
        for (const double group : sum.groups) means.push_back(float(group / double(sum.count)));
        all.push_back(std::move(noise));
    }
    return all;
}
