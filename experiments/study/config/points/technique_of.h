#pragma once
#include "experiments/study/config/config.h"
#include "variants/common/technique.h"

#include <memory>

/// The technique of a point, with the point's values. External images give a technique without parameters that cannot
/// render.
std::unique_ptr<Technique> technique_of(const PointConfig& point);

/// The point's technique with these values instead of the point's.
std::unique_ptr<Technique> technique_of(const PointConfig& point, const nlohmann::json& parameters);

/// The point's technique with its defaults.
std::unique_ptr<Technique> plain_technique_of(const PointConfig& point);
