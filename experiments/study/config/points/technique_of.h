#pragma once
#include "experiments/study/config/config.h"
#include "variants/common/technique.h"

#include <memory>

/// The technique of a point, with the point's values; of external images one without parameters, which cannot render.
std::unique_ptr<Technique> technique_of(const PointConfig& point);

/// With other values in place of the point's own.
std::unique_ptr<Technique> technique_of(const PointConfig& point, const nlohmann::json& parameters);

/// The same technique with its defaults.
std::unique_ptr<Technique> plain_technique_of(const PointConfig& point);
