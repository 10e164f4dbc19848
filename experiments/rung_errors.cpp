#include "experiments/rung_errors.h"

#include "metrics/noise.h"
#include "metrics/pooling.h"

#include <cmath>

namespace {

/// Per pixel an error, and half its change when one half alone is believed in place of the other.
struct ErrorMaps {
    Plane error, swapped;
};

ErrorMaps squared_error(const ReferenceHalves& rung, const MetricReference& truth, double (*weight)(double)) {
    ErrorMaps maps{Plane(truth.image.extent), Plane(truth.image.extent)};
    for (size_t i = 0; i < truth.image.values.size(); ++i) {
        const double a = double(rung.a.values[i]) - truth.halves->a.values[i],
                     b = double(rung.b.values[i]) - truth.halves->b.values[i], w = weight(truth.smooth.values[i]) / 3;
        maps.error.values[i / 3] += w * a * b;
        maps.swapped.values[i / 3] += w * (a * a - b * b) / 2;
    }
    return maps;
}

ErrorMaps bias(const ReferenceHalves& rung, const MetricReference& truth) {
    ErrorMaps maps{Plane(truth.image.extent), Plane(truth.image.extent)};
    for (size_t i = 0; i < truth.image.values.size(); ++i) {
        const double a = double(rung.a.values[i]) - truth.halves->a.values[i],
                     b = double(rung.b.values[i]) - truth.halves->b.values[i];
        maps.error.values[i / 3] += (a + b) / 2 / 3;
        maps.swapped.values[i / 3] += (a - b) / 2 / 3;
    }
    return maps;
}

/// What the rung is where the target is compared.
ReferenceHalves tested_halves(const RungHalves& rung, const std::string& target, const HostImage& direct) {
    if (target == "incident") return rung.incident;
    if (target == "specular") return rung.specular;
    return {sum(rung.specular.a, direct), sum(rung.specular.b, direct)};
}

nlohmann::json entry(const ErrorMaps& maps, const Metric& metric, const Mask& inside) {
    const double value = masked_mean(maps.error, inside), half_width = noise_half_width(maps.swapped, inside);
    const auto finished = [&](double v) { return metric.name == "rmse" ? std::sqrt(std::max(v, 0.0)) : v; };
    return {{"metric", metric.name},    {"formula", metric.formula},           {"mask", inside.name},
            {"value", finished(value)}, {"low", finished(value - half_width)}, {"high", finished(value + half_width)},
            {"pixels", inside.count()}};
}

void add_entries(nlohmann::json& entries, const RungHalves& rung, const std::string& target,
                 const MetricReference& truth, const HostImage& direct, std::span<const Mask> masks) {
    const ReferenceHalves tested = tested_halves(rung, target, direct);
    for (const Metric* metric : truth.metrics) {
        if (!metric->squared_error_weight && metric->name != "bias") continue;
        const ErrorMaps maps = metric->squared_error_weight ? squared_error(tested, truth, metric->squared_error_weight)
                                                            : bias(tested, truth);
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
