#pragma once
#include "core/parameters.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"
#include "experiments/study/config/shots/shot.h"

// An entry of `techniques` may be limited to some points and shots: `only_if` requires all of its conditions, `skip_if`
// excludes where all of its conditions hold. A condition is a value, an array of values, or an object of `at_least`,
// `at_most`, `above`, `below` and `not`. It tests a parameter of the point, or `shot.NAME`: `scene`, `camera`, `width`,
// `height`, `frames` (their number), settings (`lit`, `depth_format`, ...), or a fact of core/gbuffer/scene_facts.h.

/// The conditions of an entry. Fails with Error on a name that is neither a parameter of the technique nor of a shot.
std::vector<PointCondition> read_conditions(ConfigObject& entry, const ParameterSet& declared);

/// The declarations of `only_if` and `skip_if`.
Keys condition_keys();

/// Whether the point exists at all, given the values of all its parameters. Removes the conditions on parameters from
/// `conditions`; conditions on the shot remain.
bool is_wanted(std::vector<PointCondition>& conditions, const nlohmann::json& parameters);

/// Whether the point runs on the shot.
bool runs_on(const PointConfig& technique, const Shot& shot);

/// What keeps the point from running on the shot, as a condition or a clause; "" if it runs.
std::string why_skipped(const PointConfig& technique, const Shot& shot);

/// The study reduced to the points that run on the shot.
Config config_on(const Config& study, const Shot& shot);
