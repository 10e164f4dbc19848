#pragma once
#include "experiments/results/answers/answers.h"

/// What the study says of its own scenes: who errs least where, who is within the margin of that, and who is certainly
/// behind in all of them. Nothing of other scenes follows from it. Empty below two shots.
std::string in_these_scenes(const std::vector<ShotAnswer>& answers, const nlohmann::json& manifest,
                            const Headline& headline);

/// What the scenes say together of scenes like these, by the error of the headline (over_scenes.csv); empty where no
/// point has such an error beside the baseline's.
std::string in_scenes_like_these(const StudyResults& tables);
