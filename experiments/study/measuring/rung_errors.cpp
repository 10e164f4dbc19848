#include "experiments/study/measuring/rung_errors.h"

#include "metrics/pooling.h"

#include <cmath>

namespace {

/// Relative: means are float32, and rounding says nothing of paths that were not met.
constexpr double rounding = 1e-6;

/// truth - rung, as if that were a reference which black is compared with.
ReferenceHalves error_halves(const ReferenceHalves& rung, const ReferenceHalves& truth) {
    ReferenceHalves error{
        .a = truth.a, .b = truth.b, .variance = rung.variance, .guide = truth.guide, .samples = truth.samples};
    for (size_t i = 0; i < error.a.values.size(); ++i) {
        const double least = rounding * truth.a.values[i];
        if (error.variance.values[i] < least * least) error.variance.values[i] = 0;
        error.a.values[i] -= rung.a.values[i], error.b.values[i] -= rung.b.values[i];
    }
    return error;
}

NoisyMap error_map(const Metric& metric, const ReferenceHalves& error) {
    NoisyMap map;
    if (metric.squared_error_weight) {
        map = squared_error(HostImage(error.a.extent, 3), error, error.guide, metric.squared_error_weight);
    } else {
        map = mean_noise(error);
        map.error = Plane(error.a.extent);
        for (size_t i = 0; i < error.a.values.size(); ++i)
            map.error.values[i / 3] -= (double(error.a.values[i]) + error.b.values[i]) / 2 / 3;
    }
    map.is_difference = true;
    return map;
}

/// What the rung is where the target is compared.
ReferenceHalves tested_halves(const PoseTruth::Rung& rung, const std::string& target, const HostImage& direct) {
    if (target == "incident") return rung.incident;
    ReferenceHalves halves = rung.specular;
    if (target == "image") halves.a = sum(halves.a, direct), halves.b = sum(halves.b, direct);
    return halves;
}

nlohmann::json entry(const NoisyMap& map, const Metric& metric, const Mask& inside) {
    const double value = masked_mean(map.error, inside);
    nlohmann::json entry = {
        {"metric", metric.name},   {"formula", metric.guided_formula.empty() ? metric.formula : metric.guided_formula},
        {"mask", inside.name},     {"value", value},
        {"low", nullptr},          {"high", nullptr},
        {"pixels", inside.count()}};
    // Where no path showed a difference between rung and truth, another might have: 0 is not a valid width.
    if (std::optional<double> half_width = noise_half_width(map, inside); half_width.value_or(0) > 0) {
        *half_width /= double(inside.count());
        entry["low"] = value - *half_width, entry["high"] = value + *half_width;
    }
    return entry;
}

void add_entries(nlohmann::json& entries, const PoseTruth::Rung& rung, const std::string& target,
                 const MetricReference& truth, const HostImage& direct, std::span<const Mask> masks) {
    const ReferenceHalves error = error_halves(tested_halves(rung, target, direct), *truth.halves);
    for (const Metric* metric : truth.metrics) {
        if (!metric->squared_error_weight && metric->name != "bias") continue;
        const NoisyMap map = error_map(*metric, error);
        for (const Mask& mask : masks) {
            if (mask.inside.empty()) continue;  // a technique's own
            Mask inside = intersection(mask, truth.finite);
            inside.name = mask.name;
            if (inside.count() == 0) continue;
            entries.push_back(entry(map, *metric, inside));
            entries.back()["rung"] = rung.name, entries.back()["target"] = target;
        }
    }
}

}  // namespace

nlohmann::json rung_entries(const PoseTruth& truth, std::span<const Mask> masks) {
    nlohmann::json entries = nlohmann::json::array();
    for (const PoseTruth::Rung& rung : truth.rungs)
        for (const auto& [target, reference] : truth.targets)
            if (!is_ladder_rung(target)) add_entries(entries, rung, target, reference, truth.direct, masks);
    return entries;
}
