#pragma once
#include "experiments/summary.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Sentences that a reader must see before any number: a failed clock proof, references that fell short of their target,
/// pixels that are not finite, and so on. `manifest` is that of experiments/RESULTS.md; keys that are missing warn of nothing.
std::vector<std::string> report_warnings(const nlohmann::json& manifest, std::span<const ErrorSummary> errors, std::span<const TimeSummary> times);
