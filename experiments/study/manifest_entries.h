#pragma once
#include "experiments/study/measuring/left_out_by.h"

#include <nlohmann/json.hpp>
#include <string>

// The parts of manifest.json that a study writes, as experiments/docs/results_folder.md describes them.

/// Facts of the whole study, before any cell is done.
nlohmann::json study_entry(const Config& config);

/// Facts of a shot that are known before anything is rendered. `scene_warnings`: warning_sentences() of its scene.
/// `left_out`: by the study's renderers.
nlohmann::json new_shot_entry(const Shot& shot, const Config& config, const std::vector<std::string>& scene_warnings,
                              const std::vector<LeftOutBy>& left_out);
/// Adds to a new_shot_entry() what is known once the shot's references exist. Members replace those of the same name;
/// `needs` and `warnings` are joined.
void complete_shot_entry(nlohmann::json& entry, const nlohmann::json& rendered);
