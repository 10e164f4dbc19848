#pragma once
#include "experiments/study/config/shots/shot.h"

#include <nlohmann/json.hpp>
#include <string>

// The parts of manifest.json that a study writes, as experiments/RESULTS.md describes them.

/// Facts of the whole study, before any cell is done.
nlohmann::json study_entry(const Config& config);

/// All that can be said of a shot before anything of it is rendered. `scene_warnings`: warning_sentences() of its
/// scene.
nlohmann::json new_shot_entry(const Shot& shot, const Config& config, const std::vector<std::string>& scene_warnings,
                              bool keep_all);
/// Adds to a new_shot_entry() what is known once its references are there: members replace those of the same name, but
/// `needs` and `warnings` are joined.
void complete_shot_entry(nlohmann::json& entry, const nlohmann::json& rendered);
