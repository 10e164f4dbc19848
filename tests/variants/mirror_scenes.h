#pragma once
#include "tests/variants/amd_scenes.h"

/// mirror_floor before a white wall.
inline SyntheticHit floor_before_white(const CameraRay& ray) {
    SyntheticHit hit = mirror_floor(ray);
    hit.lit = glm::vec3(hit.metalness == 0);
    return hit;
}

/// The same upside down.
inline SyntheticHit ceiling_before_white(const CameraRay& ray) {
    SyntheticHit hit = floor_before_white({ray.origin * glm::vec3(1, -1, 1), ray.direction * glm::vec3(1, -1, 1)});
    hit.normal.y = -hit.normal.y;
    return hit;
}

/// A mirror half a metre before the camera, and a wall beside it that reaches from the mirror to the camera. Steps of
/// one metre along the mirrored rays end behind the camera.
inline SyntheticHit mirror_beside_wall(const CameraRay& ray) {
    const float to_mirror = -0.5f / ray.direction.z;
    const float to_wall = ray.direction.x > 0 ? 0.3f / ray.direction.x : std::numeric_limits<float>::infinity();
    if (to_wall < to_mirror) return {.distance = to_wall, .normal = {-1, 0, 0}, .lit = glm::vec3(1)};
    return {.distance = to_mirror, .normal = {0, 0, 1}, .roughness = 0, .metalness = 1, .specular = 1};
}
