#pragma once
#include "core/scene/scene.h"

/// Near and far planes (m) which cut nothing that the camera can see in any frame.
struct CameraPlanes {
    float near, far;
};

/// Far reaches 1 % beyond the farthest corner of the scene's bounds. Near is half the depth that the point of the scene
/// nearest to the eye would have in the corner of a picture twice as wide as high, but no less than a millionth of far.
/// The scene and the camera are looked at in the keys of the camera's path, and in 9 frames of what it films where
/// something moves. 0.1 and 100 where there is no geometry; near is 0 for an orthographic camera, whose depth loses
/// nothing by it.
CameraPlanes derive_planes(const SceneCamera& camera, const Scene& scene);
