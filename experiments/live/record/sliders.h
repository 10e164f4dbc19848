#pragma once
#include "experiments/live/record/recorder.h"
#include "experiments/study/config/config.h"

#include <nlohmann/json.hpp>
#include <set>

class Device;

/// What the rows of elements/parameters.js show: {"name", "type" ("float", "int", "uint", "bool"), "unit", "doc",
/// "value", "initial", "min", "max", "choices"}.
nlohmann::json slider_json(const Parameter& p);

/// What the page shows of a technique's parameters: first those of its uniform block, in the block's order:
/// slider_json() with "is_slider" and "why_not". A slider changes a value of the block and nothing else: parameters
/// that also decide passes, images or push constants have none, nor do those that no recorded program reads (`read`:
/// places of those that one does). Whether a parameter decides more is found by rendering with its least and its
/// largest value. Then the parameters that the chosen parts of the technique have compiled in, which have no slider
/// either.
nlohmann::json recorded_parameters(Device& device, const PointConfig& point, glm::uvec2 extent,
                                   const std::set<unsigned>& read, KnownReads& known_reads);

/// Renders two frames of an empty G-buffer. Fails with Error, naming the pass, if WebGL 2 cannot do what the technique
/// does, or if it has no passes.
void require_replayable(Device& device, const PointConfig& point);
