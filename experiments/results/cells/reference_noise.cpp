#include "experiments/results/cells/reference_noise.h"

#include "metrics/direction.h"
#include "metrics/noise.h"
#include "metrics/temporal.h"

#include <algorithm>
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

bool is_extrapolated(const std::string& metric) {
    return !find_temporal_metric(metric) && !metric_named(metric).squared_error_weight;
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
    return squared_error(test, *reference.halves, reference.halves->guide, metric.squared_error_weight).swapped;
}

void add_swapped_errors(SumsOfErrors& noise, const std::string& frame, const std::string& target,
                        const MetricReference& reference, const HostImage& test, std::span<const Mask> masks) {
    if (!reference.halves) return;
    for (const Metric* metric : reference.metrics) {
        if (!metric->squared_error_weight) continue;
        const Plane swapped = swapped_error(*metric, reference, test);
        for (const Mask& mask : masks) {
            const Mask inside = intersection(mask, reference.finite);
            if (inside.count() == 0) continue;
            noise[{target, metric->name, mask.name, frame}].add(group_sums(swapped, inside));
        }
    }
}

void add_growth(SumsOfErrors& noise, const ErrorName& error, const NoiseGrowth& growth) {
    // No ratio of two counts of outliers was simulated, and the intervals of ratios of mean absolute differences did
    // not cover (metrics/coverage.md): such effects have no interval.
    if (growth.empty() || !is_error(error.metric) || error.metric == "outliers" || error.metric == "mae") return;
    noise[error].add(growth);
}

std::vector<ReferenceNoise> means_of(const SumsOfErrors& noise, const ReferenceNoise& shared) {
    std::vector<ReferenceNoise> all;
    for (const auto& [error, sum] : noise) {
        if (error.frame != over_frames && noise.contains({error.target, error.metric, error.mask, over_frames}))
            continue;
        ReferenceNoise row = shared;
        row.frame = error.frame, row.target = error.target, row.metric = error.metric, row.mask = error.mask;
        std::vector<float>& means = is_extrapolated(error.metric) ? row.growth : row.sums;
        for (const double total : sum.total) means.push_back(float(total / double(sum.count)));
        all.push_back(std::move(row));
    }
    return all;
}
