#pragma once
#include "core/scene/camera.h"

/// Depths along a camera's -z (m) between which all lies that it looks at; `farthest` is negative if that is nothing.
struct DepthRange {
    double nearest, farthest;

    bool is_empty() const { return farthest < 0; }
};

/// Of all triangles within the borders of an image of `extent` and before the eye: clip planes, masks, culled backs and
/// what hides what are not looked at. A few operations for each triangle.
DepthRange depths_in_view(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);

/// The same of boxes about instances, inside the borders or not: it holds depths_in_view(), for a few operations each.
DepthRange depths_of_boxes(const Scene& scene, const ScenePose& pose, const CameraPose& camera);
