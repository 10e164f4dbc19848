#pragma once
#include "groundtruth/reference/reference.h"

#include <functional>

/// Seeds of a probe's six views: this one and the next five. A reference with one of these seeds would draw the same
/// samples.
inline constexpr unsigned first_probe_seed = 0x9cf5b, probe_views = 6;

/// Renders a reference of a shot's scene from another camera.
using ProbeView =
    std::function<Reference(const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& settings)>;

/// A reflection probe, as engines place them in rooms: all light that arrives at `position` (m), path traced, as an
/// environment image. Reflections show it where a technique finds nothing; without a probe, a room's floor reflects the
/// sky that its ceiling hides. The image counts as infinitely far away, like an engine's probe without a proxy shape.
///
/// It consists of six square views of 32 x 32 pixels with 64 samples, so that a texel is about 3 degrees wide.
/// `settings`: the study's, of which depth and keep_all are used.
///
/// A probe is a part of the scene, like one that an engine has baked. Its samples have seeds of their own, which no
/// reference of a study with probes may have. Studies with other references read the same probe, and so do images that
/// another program rendered with it. What the probe's noise does to a technique is therefore not in the scatter of the
/// study's numbers, and no interval includes it. metrics/coverage.md states its size (`probe_coverage_study`).
Environment reflection_probe(glm::vec3 position, const ReferenceSettings& settings, const ProbeView& render);
