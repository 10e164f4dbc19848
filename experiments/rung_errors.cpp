#include "experiments/rung_errors.h"

#include "metrics/pooling.h"

#include <cmath>

namespace {

/// Per pixel an error, and how the noise of both moves it.
struct ErrorMaps {
    Plane error;
    NoiseTerms noise;

    ErrorMaps(glm::uvec2 extent, double samples) : error(extent), noise(extent, samples) {}
};

ErrorMaps squared_error(const ReferenceHalves& rung, const ReferenceHalves& truth, double (*weight)(double)) {
    ErrorMaps maps(truth.a.extent, truth.samples);
    for (size_t p = 0; p < maps.error.values.size(); ++p) {
        for (size_t i = 3 * p; i < 3 * p + 3; ++i) {
            const double a = double(rung.a.values[i]) - truth.a.values[i],
                         b = double(rung.b.values[i]) - truth.b.values[i], w = weight(truth.guide.values[i]) / 3;
            maps.error.values[p] += w * a * b;
            maps.noise.swapped.values[p] += w * (a * a - b * b) / 2;
        }
        maps.noise.take_squares(p);  // rung and truth share their samples
    }
    return maps;
}

ErrorMaps bias(const ReferenceHalves& rung, const ReferenceHalves& truth) {
    ErrorMaps maps(truth.a.extent, truth.samples);
    for (size_t p = 0; p < maps.error.values.size(); ++p) {
        for (size_t i = 3 * p; i < 3 * p + 3; ++i) {
            const double a = double(rung.a.values[i]) - truth.a.values[i],
                         b = double(rung.b.values[i]) - truth.b.values[i];
            maps.error.values[p] += (a + b) / 2 / 3;
            maps.noise.swapped.values[p] += (a - b) / 2 / 3;
        }
        maps.noise.take_squares(p);  // rung and truth share their samples
    }
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
    const auto finished = [&](double v) { return metric.name == "rmse" ? std::sqrt(std::max(v, 0.0)) : v; };
    nlohmann::json entry = {
        {"metric", metric.name},   {"formula", metric.guided_formula.empty() ? metric.formula : metric.guided_formula},
        {"mask", inside.name},     {"value", finished(value)},
        {"low", nullptr},          {"high", nullptr},
        {"pixels", inside.count()}};
    if (std::optional<double> half_width = noise_half_width(maps.noise, inside)) {
        *half_width /= double(inside.count());
        entry["low"] = finished(value - *half_width), entry["high"] = finished(value + *half_width);
    }
    return entry;
}

void add_entries(nlohmann::json& entries, const RungHalves& rung, const std::string& target,
                 const MetricReference& truth, const HostImage& direct, std::span<const Mask> masks) {
    const ReferenceHalves tested = tested_halves(rung, target, direct);
    for (const Metric* metric : truth.metrics) {
        if (!metric->squared_error_weight && metric->name != "bias") continue;
        const ErrorMaps maps = metric->squared_error_weight
                                   ? squared_error(tested, *truth.halves, metric->squared_error_weight)
                                   : bias(tested, *truth.halves);
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
