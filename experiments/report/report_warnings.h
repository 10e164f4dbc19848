#pragma once
#include "experiments/results/verdicts/summary.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Sentences that a reader must see before any number: the study's own (`warnings` of the manifest and
/// of its shots), points whose results differ from run to run, a timer that was not validated, references that fell
/// short of their target, pixels that are not finite, and so on. `manifest` is that of experiments/RESULTS.md; keys
/// that are missing warn of nothing.
std::vector<std::string> report_warnings(const nlohmann::json& manifest, std::span<const MetricSummary> errors,
                                         std::span<const TimeSummary> times);
