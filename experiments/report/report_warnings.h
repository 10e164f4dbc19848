#pragma once
#include "experiments/results/verdicts/summary.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Sentences that a reader must see before any number: the study's own `warnings` and those of its shots, points that
/// differ from run to run, an unvalidated timer, references short of their target, pixels that are not finite, and
/// others. `manifest` is manifest.json; a missing key warns of nothing.
std::vector<std::string> report_warnings(const nlohmann::json& manifest, std::span<const MetricSummary> errors,
                                         std::span<const TimeSummary> times);
