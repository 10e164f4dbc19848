#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"

/// Numbers of pixels whose nearest surface the camera's planes cut away: such pixels show what lies behind, or nothing.
struct PlaneCuts {
    size_t before_near = 0, beyond_far = 0;

    size_t count() const { return before_near + beyond_far; }
};

/// Traces one ray a pixel, at its centre.
PlaneCuts count_plane_cuts(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);
