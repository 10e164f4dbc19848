#ifndef SHARED_ENVIRONMENT_H
#define SHARED_ENVIRONMENT_H
#include "core/shared/language.h"

// A latitude-longitude environment image: u = 0.5 + atan2(z, x) / (2 pi), v = acos(y) / pi, so that the middle of the
// image is +X, its left half -Z, and its top row +Y. A positive rotation turns the image counter-clockwise as seen from
// +Y (the right-hand rule): at 90 degrees its middle is seen along -Z.

/// `direction`: unit, world space, away from the scene. `rotation`: radians about +Y. u in [0, 1], v in [0, 1].
SHARED vec2 environment_uv(vec3 direction, float rotation) {
    const float pi_environment = 3.14159265358979f;
    // Turning the image by +rotation is turning the direction by -rotation, which adds to the angle from +X towards +Z.
#ifdef __cplusplus
    float azimuth = std::atan2(direction.z, direction.x) + rotation;
#else
    float azimuth = atan(direction.z, direction.x) + rotation;
#endif
    float u = 0.5f + azimuth / (2.0f * pi_environment);
    return vec2(u - floor(u), acos(clamp(direction.y, -1.0f, 1.0f)) / pi_environment);
}

/// The inverse of environment_uv().
SHARED vec3 environment_direction(vec2 uv, float rotation) {
    const float pi_environment = 3.14159265358979f;
    float azimuth = (uv.x - 0.5f) * 2.0f * pi_environment - rotation;
    float polar = uv.y * pi_environment;
    return vec3(sin(polar) * cos(azimuth), cos(polar), sin(polar) * sin(azimuth));
}
#endif
