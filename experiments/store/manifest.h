#pragma once
#include "experiments/config/shots/shot.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

// The parts of manifest.json, as experiments/RESULTS.md describes them.

/// {name: {"formula", "unit", "better", "doc"}} of all metrics, and of both parts of a squared error: the one source of
/// which values are good, for report, tables and figures.
nlohmann::json metric_descriptions();

/// Facts of the whole study, before any cell is done.
nlohmann::json study_entry(const Config& config);

/// The A/A floor of a shot, relative to the mean time; none where no point was timed twice.
std::optional<double> aa_floor(const nlohmann::json& manifest, const std::string& shot);

/// How many pairs of copies were timed in a shot.
size_t aa_pair_count(const nlohmann::json& manifest, const std::string& shot);

/// All that can be said of a shot before anything of it is rendered. `scene_warnings`: warning_sentences() of its
/// scene.
nlohmann::json shot_entry(const Shot& shot, const Config& config, const std::vector<std::string>& scene_warnings,
                          bool keep_all);
/// Adds to a shot_entry() what is known once its references are there: members replace those of the same name, but
/// `needs` and `warnings` are joined.
void complete_shot_entry(nlohmann::json& entry, const nlohmann::json& rendered);
