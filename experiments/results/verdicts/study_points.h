#pragma once
#include "experiments/results/verdicts/effects/effects.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// The error that the study is made to compare, with its margin; missing values have a config's defaults.
PrimaryComparisons primary_of(const nlohmann::json& manifest);

/// Points that differ from a baseline of their technique in one swept parameter (config/comparisons.h), from the
/// manifest. A study may hold dozens: the list of effects shows them, most tables and charts do not.
PointSet single_changes(const nlohmann::json& manifest);

/// {technique: {parameter: default}} of the manifest's techniques in this build; unknown techniques are left out.
nlohmann::json parameter_defaults(const nlohmann::json& manifest);

/// Points that do not depend on seeds, from the manifest; points without an entry count as depending on seeds.
PointSet points_without_seeds(const nlohmann::json& manifest);

/// Points whose results differ from run to run.
PointSet points_not_repeatable(const nlohmann::json& manifest);

/// Points that use scene data, which no engine has (exact_scene, exact_rays). They are never ranked.
PointSet points_using_scene_data(const nlohmann::json& manifest);
