#include "experiments/study/measuring/lit_noise.h"

#include "metrics/noise.h"
#include "metrics/pooling.h"
#include "metrics/statistics/quantiles.h"
#include "metrics/tiles.h"

#include <cmath>

namespace {

/// Per pixel: what is added to the error, and half the error's change from half A's light to half B's, which varies as
/// much as the error does with the noise of the mean.
struct LitMaps {
    Plane added, swapped;
};

LitMaps squared_error_maps(const Metric& metric, const MetricReference& reference, const HostImage& of_a,
                           const HostImage& of_b) {
    const auto weight = metric.squared_error_weight;
    const ReferenceHalves& halves = *reference.halves;
    LitMaps maps{Plane(of_a.extent), cross_error(of_a, halves.a, halves.b, halves.guide, weight)};
    const Plane error_of_b = cross_error(of_b, halves.a, halves.b, halves.guide, weight);
    for (size_t i = 0; i < maps.added.values.size(); ++i) {
        maps.swapped.values[i] = (maps.swapped.values[i] - error_of_b.values[i]) / 2;
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double difference = double(of_a.values[c]) - of_b.values[c];
            maps.added.values[i] += weight(halves.guide.values[c]) * difference * difference / 4 / 3;
        }
    }
    return maps;
}

LitMaps bias_maps(const HostImage& of_a, const HostImage& of_b) {
    LitMaps maps{Plane(of_a.extent), Plane(of_a.extent)};
    for (size_t i = 0; i < of_a.values.size(); ++i)
        maps.swapped.values[i / 3] += (double(of_a.values[i]) - of_b.values[i]) / 2 / 3;
    return maps;
}

/// Techniques spread what they read over neighbouring pixels, so tiles are what is independent. Each is one component
/// of the variance with one degree of freedom (Satterthwaite 1946).
double half_width_of(const Plane& swapped, const Mask& mask) {
    double variance = 0, squares = 0;
    for (const double sum : tile_sums(swapped, mask)) variance += sum * sum, squares += sum * sum * sum * sum;
    if (variance == 0) return 0;
    return student_t_quantile(0.975, variance * variance / squares) * std::sqrt(variance) / double(mask.count());
}

/// Pixels that are finite in both results, or comparing them would say nothing of the rest.
Mask finite_in(const HostImage& of_a, const HostImage& of_b, const Mask& finite) {
    Mask both = finite;
    for (size_t i = 0; i < of_a.values.size(); ++i)
        if (!std::isfinite(of_a.values[i]) || !std::isfinite(of_b.values[i])) both.inside[i / 3] = 0;
    return both;
}

bool is_told_for(const Metric& metric) { return metric.squared_error_weight || metric.name == "bias"; }

void add(LitNoiseOfErrors& noise, const MetricReference& reference, const std::string& target, const HostImage& of_a,
         const HostImage& of_b, std::span<const Mask> masks, const std::string& frame) {
    if (!reference.halves) return;
    const Mask finite = finite_in(of_a, of_b, reference.finite);
    for (const Metric* metric : reference.metrics) {
        const bool is_bias = metric->name == "bias";
        if (!is_told_for(*metric)) continue;
        const LitMaps maps = is_bias ? bias_maps(of_a, of_b) : squared_error_maps(*metric, reference, of_a, of_b);
        for (const Mask& mask : masks) {
            const Mask inside = intersection(mask, finite);
            if (inside.count() == 0) continue;
            (*noise)[{target, metric->name, mask.name, frame}] = {masked_mean(maps.added, inside),
                                                                  half_width_of(maps.swapped, inside)};
        }
    }
}

}  // namespace

bool is_noisy(const ReferenceHalves& light) {
    for (size_t i = 0; i < light.a.values.size(); ++i) {
        const float a = light.a.values[i], b = light.b.values[i];
        if (std::abs(a - b) > 1e-5f * std::max(std::abs(a), std::abs(b))) return true;
    }
    return false;
}

void add_lit_noise_of_targets(LitNoiseOfErrors& noise, const PoseTruth& truth, const CompositedImages& of_a,
                              const CompositedImages& of_b, std::span<const Mask> masks, const std::string& frame) {
    const HostImage image_a = composited_image(truth, of_a), image_b = composited_image(truth, of_b);
    for (const auto& [target, reference] : truth.targets)
        if (const HostImage& a = tested_image(target, of_a, image_a); !a.values.empty())
            add(noise, reference, target, a, tested_image(target, of_b, image_b), masks, frame);
}

void add_lit_noise_of_frame(LitNoiseOfErrors& noise, const PoseTruth& truth, const CompositedImages& of_a,
                            const CompositedImages& of_b, std::span<const Mask> masks, const std::string& frame) {
    add(noise, *truth.frame_reference, "specular", of_a.specular, of_b.specular, masks, frame);
}

std::optional<LitNoise> lit_noise_of(const LitNoiseOfErrors& noise, const ErrorName& error) {
    if (!noise) return is_told_for(metric_named(error.metric)) ? std::optional(LitNoise{}) : std::nullopt;
    const auto found = noise->find(error);
    return found == noise->end() ? std::nullopt : std::optional(found->second);
}

void set_lit_noise(std::span<ResultRow> rows, const LitNoiseOfErrors& noise) {
    for (ResultRow& row : rows)
        if (const auto known = lit_noise_of(noise, {row.target, row.metric, row.mask, row.frame}))
            row.lit_noise = known->added, row.lit_half_width = known->half_width;
}
