#pragma once
#include "experiments/study/config/config.h"

/// A point of a study with seed 1: a technique, by name or folder (technique_name() of variants/registry.h), with a
/// preset ("": none) and parameter values.
PointConfig single_point(const std::string& technique, const std::string& preset = "",
                         const nlohmann::json& parameters = nlohmann::json::object());

/// The names that select a point: its technique's, and NAME:POINT.
std::vector<std::string> names_of_point(const PointConfig& point);

/// All presets of all techniques, and all tracers in the plainest technique. The tracer exact_scene is left out: it
/// needs the scene, which no screen has. `names` selects points as names_of_point() does; a technique's folder may
/// stand for its name; empty: all. Fails with Error on an unknown name, with the nearest one.
std::vector<PointConfig> all_points(const std::vector<std::string>& names = {});
