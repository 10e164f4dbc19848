#include "experiments/config/primary_comparisons.h"

#include "metrics/temporal.h"

#include <algorithm>

namespace {

/// What a study measures at all speaks for it, unless it says otherwise: `wanted`, else the first.
std::string wanted_or_first(const std::string& wanted, const std::vector<std::string>& measured) {
    return measured.empty() || std::ranges::count(measured, wanted) > 0 ? wanted : measured.front();
}

std::vector<std::string> errors_in(const std::vector<std::string>& metrics) {
    std::vector<std::string> errors;
    for (const std::string& name : metrics)
        if (is_error(name)) errors.push_back(name);
    return errors;
}

/// Errors that the study measures in some shot: those of its metrics, of single frames, and of sequences of frames.
std::vector<std::string> measured_errors(const Config& config) {
    std::vector<std::string> errors = errors_in(config.metrics);
    for (const std::string& name : errors_in(config.frame_metrics)) errors.push_back(name);
    for (const TemporalMetric& metric : temporal_metrics())
        if (is_error(metric.name)) errors.push_back(metric.name);
    return errors;
}

}  // namespace

PrimaryComparisons read_primary(JsonObject& study, const Config& config) {
    PrimaryComparisons primary;
    primary.metric = wanted_or_first(primary.metric, errors_in(config.metrics));
    primary.mask = wanted_or_first(primary.mask, config.masks);
    primary.target = wanted_or_first(primary.target, config.targets);
    if (!study.has("primary")) return primary;
    JsonObject object = study.object("primary");
    primary.metric = object.choice("metric", measured_errors(config), primary.metric);
    primary.mask = object.choice("mask", config.masks, primary.mask);
    primary.target = object.choice("target", config.targets, primary.target);
    object.finish();
    return primary;
}
