#pragma once
#include "core/parameters.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"
#include "experiments/study/config/shots/shot.h"

// An entry of `techniques` may hold for some points and shots only: `only_if` all of its conditions hold, and not
// (`skip_if`) where all of its conditions do. A condition is a value, an array of values, or an object of `at_least`,
// `at_most`, `above`, `below` and `not`. What it is put to is a parameter of the point, or `shot.NAME`: `scene`,
// `camera`, `width`, `height`, `frames` (how many), settings (`lit`, `depth_format`, ...), and the facts of
// core/gbuffer/scene_facts.h.

/// The conditions of an entry. Fails on what is neither a parameter of the technique nor a name of a shot.
std::vector<PointCondition> read_conditions(ConfigObject& entry, const ParameterSet& declared);

/// `only_if` and `skip_if` of an entry.
Keys condition_keys();

/// Whether the point is to be at all, by the values of all its parameters. Conditions that they decide are taken out of
/// `conditions`; those are left that depend on the shot.
bool is_wanted(std::vector<PointCondition>& conditions, const nlohmann::json& parameters);

/// Whether the point runs on the shot.
bool runs_on(const PointConfig& technique, const Shot& shot);

/// The condition for which it does not; "" if it does.
std::string why_skipped(const PointConfig& technique, const Shot& shot);

/// The study with only the points that run on the shot.
Config config_on(const Config& study, const Shot& shot);
