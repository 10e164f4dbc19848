#pragma once
#include "groundtruth/reference/reference.h"

#include <functional>

/// Seeds of a probe's views: this and the next five. A reference of the same seed would draw the same samples.
inline constexpr unsigned first_probe_seed = 0x9cf5b, probe_views = 6;

/// Renders a reference of a shot's scene from another camera.
using ProbeView =
    std::function<Reference(const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& settings)>;

/// A reflection probe, as engines place them in rooms: all light that arrives at `position` (m), path traced, as an
/// environment image. Reflections show it where a technique finds nothing; without one a room's floor reflects the sky
/// that its ceiling hides. It is taken for infinitely far away, as engines take a probe without a proxy shape.
///
/// Six square views of 32 pixels and 64 samples make it, so that a texel is some 3 degrees wide. `settings`: the
/// study's, of which its depth and keep_all are used.
///
/// A probe is a part of the scene, as one that an engine has baked: its samples have seeds of their own, which no
/// reference of a study with probes may have. Studies with other references read the same probe, and so do images that
/// another program rendered with it. What its noise does to a technique is therefore no scatter of the study's numbers,
/// and no interval holds it. Its size is measured in metrics/README.md (`probe_coverage_study`).
Environment reflection_probe(glm::vec3 position, const ReferenceSettings& settings, const ProbeView& render);
