#pragma once
#include "core/scene/scene.h"

/// Near and far planes (m) which cut nothing that the camera can see in any frame.
struct CameraPlanes {
    float near, far;
};

/// Far is 1 % beyond the farthest corner of the scene's bounds. Take the scene's point nearest to the eye, placed in
/// the corner of a picture twice as wide as high: near is half its depth, and at least a millionth of far. Both come
/// from the keys of the camera's path and, if something moves, from 9 frames; planes_for_all_frames() then widens them.
/// They are 0.1 and 100 without geometry. Near is 0 for an orthographic camera, whose depth precision does not suffer.
CameraPlanes derive_planes(const SceneCamera& camera, const Scene& scene);

/// derive_planes().far, without the time that near takes.
float derive_far(const SceneCamera& camera, const Scene& scene);

/// Sets the camera's planes to those of derive_planes().
void use_planes_of_scene(SceneCamera& camera, const Scene& scene);

/// `planes` if they cut nothing in any whole frame, from 0 until camera and scene stand still. Else wider planes, as
/// derive_planes() has them for the frame with the nearest surface and the one with the farthest. Pictures are at most
/// twice as wide as high. They are at most as high as wide, or twice as high if the camera has an aspect.
CameraPlanes planes_for_all_frames(const CameraPlanes& planes, const SceneCamera& camera, const Scene& scene);
