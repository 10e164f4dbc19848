#pragma once
#include "experiments/results/verdicts/effects/effects.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// The error that the study is made to compare, with its margin; what the manifest lacks is as a config has it.
PrimaryComparisons primary_of(const nlohmann::json& manifest);

/// Points that differ from a baseline of their technique in one swept parameter (config/comparisons.h), as the
/// manifest has them. A study may hold dozens: they belong into the list of effects, not into every table and chart.
PointSet single_changes(const nlohmann::json& manifest);

/// {technique: {parameter: default}} of the manifest's techniques, as this build has them; those that it does not know
/// are left out.
nlohmann::json parameter_defaults(const nlohmann::json& manifest);

/// Points that do not depend on seeds, as the manifest has them. Points without that entry are not among them.
PointSet points_without_seeds(const nlohmann::json& manifest);

/// Points whose results differ from run to run.
PointSet points_not_repeatable(const nlohmann::json& manifest);

/// Points that use scene data, which no engine has (exact_scene, exact_rays): they are never ranked.
PointSet points_using_scene_data(const nlohmann::json& manifest);
