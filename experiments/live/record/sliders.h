#pragma once
#include "experiments/live/record/recorder.h"
#include "experiments/study/config/config.h"

#include <nlohmann/json.hpp>
#include <set>

class Device;

/// A row of elements/parameters.js: {"name", "type" ("float", "int", "uint", "bool"), "unit", "doc", "value",
/// "initial", "min", "max", "choices"}.
nlohmann::json slider_json(const Parameter& p);

/// A technique's parameters in the page, as slider_json() with "is_slider" and "why_not". First come the parameters of
/// the uniform block, in the block's order. A slider may change a value of the block and nothing else. Parameters that
/// also decide passes, images or push constants have no slider; rendering with the least and the largest value finds
/// them. Parameters that no recorded program reads have none either (`read`: indices of those that one reads). Then
/// come the parameters compiled into the chosen parts of the technique, without sliders.
nlohmann::json recorded_parameters(Device& device, const PointConfig& point, glm::uvec2 extent,
                                   const std::set<unsigned>& read, KnownReads& known_reads);

/// Renders two frames of an empty G-buffer. Fails with Error that names the pass if WebGL 2 cannot do what the
/// technique does, or if it has no passes.
void require_replayable(Device& device, const PointConfig& point);
