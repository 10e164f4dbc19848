#pragma once
#include "core/scene/camera.h"

/// The range of depths (m, along -z) of what a camera looks at; `farthest` is negative if there is nothing.
struct DepthRange {
    double nearest, farthest;

    bool is_empty() const { return farthest < 0; }
};

/// Depths of all triangles within the borders of an image of `extent` and in front of the eye. Ignores clip planes,
/// masks, culled backs and occlusion. Takes a few operations per triangle.
DepthRange depths_in_view(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);

/// Depths of the boxes around instances, inside the borders or not. Contains depths_in_view(); takes a few operations
/// each.
DepthRange depths_of_boxes(const Scene& scene, const ScenePose& pose, const CameraPose& camera);
