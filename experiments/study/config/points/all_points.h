#pragma once
#include "experiments/study/config/config.h"

/// A technique, by its name or its folder (technique_name() of variants/registry.h), with a preset ("": none) and
/// parameter values as a point of a study, with seed 1.
PointConfig single_point(const std::string& technique, const std::string& preset = "",
                         const nlohmann::json& parameters = nlohmann::json::object());

/// The names that a point is chosen by: its technique's, and NAME:POINT.
std::vector<std::string> names_of_point(const PointConfig& point);

/// Presets of all techniques, and all tracers but exact_scene, which no screen can have, in the plainest technique.
/// `names`: which of them, as names_of_point() has them, or with a technique's folder in place of its name; none: all.
/// Fails with Error (and a near miss) on an unknown one.
std::vector<PointConfig> all_points(const std::vector<std::string>& names = {});
