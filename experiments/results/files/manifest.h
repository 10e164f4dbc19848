#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

// What is read from manifest.json (experiments/RESULTS.md).

/// {name: {"formula", "unit", "better", "doc"}} of all metrics, and of both parts of a squared error: the one source of
/// which values are good, for report, tables and figures.
nlohmann::json metric_descriptions();

/// The A/A floor of a shot, relative to the mean time; none where no point was timed twice.
std::optional<double> aa_floor(const nlohmann::json& manifest, const std::string& shot);

/// How many pairs of copies were timed in a shot.
size_t aa_pair_count(const nlohmann::json& manifest, const std::string& shot);
