#pragma once
#include "experiments/results/answers/answers.h"

/// What holds in the study's own scenes: which points err least where, which lie within the margin, and which are
/// certainly behind in all of them. It says nothing about other scenes. Empty below two shots.
std::string in_these_scenes(const std::vector<ShotAnswer>& answers, const nlohmann::json& manifest,
                            const Headline& headline);

/// What may hold in other scenes like these, by the headline's error (over_scenes.csv). Empty if no point but the
/// baseline has such an error.
std::string in_scenes_like_these(const StudyResults& tables);
