#include "experiments/study/measuring/rung_errors.h"

#include "metrics/pooling.h"

#include <cmath>

namespace {

/// Per pixel an error, and how the noise of both moves it.
struct ErrorMaps {
    Plane error;
    NoiseTerms noise;
};

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

ErrorMaps squared_error(const ReferenceHalves& error, double (*weight)(double)) {
    const HostImage black(error.a.extent, 3);
    ErrorMaps maps{cross_error(black, error.a, error.b, error.guide, weight),
                   squared_error_noise(black, error, error.guide, weight)};
    maps.noise.is_difference = true;
    return maps;
}

ErrorMaps bias(const ReferenceHalves& error) {
    ErrorMaps maps{Plane(error.a.extent), mean_noise(error)};
    maps.noise.is_difference = true;
    for (size_t i = 0; i < error.a.values.size(); ++i)
        maps.error.values[i / 3] -= (double(error.a.values[i]) + error.b.values[i]) / 2 / 3;
    return maps;
}

/// What the rung is where the target is compared.
ReferenceHalves tested_halves(const RungHalves& rung, const std::string& target, const HostImage& direct) {
    if (target == "incident") return rung.incident;
    ReferenceHalves halves = rung.specular;
    if (target == "image") halves.a = sum(halves.a, direct), halves.b = sum(halves.b, direct);
    return halves;
}

nlohmann::json entry(const ErrorMaps& maps, const Metric& metric, const Mask& inside) {
    const double value = masked_mean(maps.error, inside);
    nlohmann::json entry = {
        {"metric", metric.name},   {"formula", metric.guided_formula.empty() ? metric.formula : metric.guided_formula},
        {"mask", inside.name},     {"value", value},
        {"low", nullptr},          {"high", nullptr},
        {"pixels", inside.count()}};
    // Where no path showed a difference between rung and truth, another might have: 0 is not a valid width.
    if (std::optional<double> half_width = noise_half_width(maps.noise, inside); half_width.value_or(0) > 0) {
        *half_width /= double(inside.count());
        entry["low"] = value - *half_width, entry["high"] = value + *half_width;
    }
    return entry;
}

void add_entries(nlohmann::json& entries, const RungHalves& rung, const std::string& target,
                 const MetricReference& truth, const HostImage& direct, std::span<const Mask> masks) {
    const ReferenceHalves error = error_halves(tested_halves(rung, target, direct), *truth.halves);
    for (const Metric* metric : truth.metrics) {
        if (!metric->squared_error_weight && metric->name != "bias") continue;
        const ErrorMaps maps =
            metric->squared_error_weight ? squared_error(error, metric->squared_error_weight) : bias(error);
        for (const Mask& mask : masks) {
            if (mask.inside.empty()) continue;  // a technique's own
            Mask inside = intersection(mask, truth.finite);
            inside.name = mask.name;
            if (inside.count() == 0) continue;
            entries.push_back(entry(maps, *metric, inside));
            entries.back()["rung"] = rung.name, entries.back()["target"] = target;
        }
    }
}

}  // namespace

nlohmann::json rung_entries(const PoseTruth& truth, std::span<const Mask> masks) {
    nlohmann::json entries = nlohmann::json::array();
    for (const RungHalves& rung : truth.rungs)
        for (const auto& [target, reference] : truth.targets)
            if (!is_ladder_rung(target)) add_entries(entries, rung, target, reference, truth.direct, masks);
    return entries;
}
