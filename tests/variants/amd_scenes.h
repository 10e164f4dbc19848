#pragma once
#include "tests/variants/synthetic_gbuffer.h"

/// The floor of mirror_floor in strips along z, 1 m wide, of perceptual roughness 0, 0.1, 0.2, 0.3 and 0.4, again and
/// again, before its wall in a checker of 0.25 and 1 (W sr^-1 m^-2).
inline SyntheticHit glossy_floor(const CameraRay& ray) {
    SyntheticHit hit = mirror_floor(ray);
    const glm::vec3 p = ray.origin + hit.distance * ray.direction;
    if (hit.metalness > 0)
        hit.roughness = 0.1f * float((int(std::floor(p.x)) + 100) % 5);
    else
        hit.lit = glm::vec3((int(std::floor(p.x)) + int(std::floor(p.y))) & 1 ? 1.0f : 0.25f);
    return hit;
}

/// The floor of mirror_floor without its wall.
inline SyntheticHit floor_below_nothing(const CameraRay& ray) {
    const SyntheticHit hit = mirror_floor(ray);
    return hit.metalness > 0 ? hit : SyntheticHit{};
}
