#pragma once
#include "groundtruth/reference/reference.h"

#include <functional>

/// Renders a reference of a shot's scene from another camera.
using ProbeView =
    std::function<Reference(const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& settings)>;

/// A reflection probe, as engines place them in rooms: all light that arrives at `position` (m), path traced, as an
/// environment image. Reflections show it where a technique finds nothing; without one a room's floor reflects the sky
/// that its ceiling hides. It is taken for infinitely far away, as engines take a probe without a proxy shape.
///
/// Six square views of 32 pixels and 64 samples make it, so that a texel is some 3 degrees wide. `settings`: the
/// study's, of which its depth, seed and keep_all are used.
Environment reflection_probe(glm::vec3 position, const ReferenceSettings& settings, const ProbeView& render);
