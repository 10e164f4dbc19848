#pragma once
#include "core/scene/scene.h"

/// Near and far planes (m) which cut nothing that the camera can see in any frame.
struct CameraPlanes {
    float near, far;
};

/// Far reaches 1 % beyond the farthest corner of the scene's bounds. Near is half the depth that the point of the scene
/// nearest to the eye would have in the corner of a picture twice as wide as high, but no less than a millionth of far.
/// Both come from the keys of the camera's path, and from 9 frames of what it films where something moves; then
/// planes_for_all_frames() widens them. 0.1 and 100 where there is no geometry; near is 0 for an orthographic camera,
/// whose depth loses nothing by it.
CameraPlanes derive_planes(const SceneCamera& camera, const Scene& scene);

/// derive_planes().far, without the time that near takes.
float derive_far(const SceneCamera& camera, const Scene& scene);

/// Gives the camera the planes that derive_planes() has for it.
void use_planes_of_scene(SceneCamera& camera, const Scene& scene);

/// `planes` where they cut nothing in any whole frame, from 0 until neither camera nor scene moves any more; else
/// wider: as derive_planes() has them, of the frame that comes nearest and of the one that goes farthest. Pictures are
/// at most twice as wide as high, or as high as wide, or half as wide where the camera has an aspect.
CameraPlanes planes_for_all_frames(const CameraPlanes& planes, const SceneCamera& camera, const Scene& scene);
