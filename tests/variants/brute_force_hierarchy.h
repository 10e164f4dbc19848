#pragma once
#include "core/host_image.h"
#include "core/shared/camera.h"

/// Where a ray ends that takes the depth buffer for a wall without a back: at the first surface that it is behind of,
/// or where it leaves the screen.
struct BruteForceEnd {
    bool is_on_screen = false;
    double distance = 0;  ///< m
};

/// Visits every pixel on the ray's line, in double, without any hierarchy. The pixel that the ray starts from is left
/// out. `depth`: device depth, without jitter. `direction`: unit, view space; a pixel's point is `origin`.
BruteForceEnd brute_force_end(const HostImage& depth, const CameraData& camera, glm::uvec2 origin,
                              glm::dvec3 direction);

/// The point of a pixel, view space.
glm::dvec3 view_point(const HostImage& depth, const CameraData& camera, glm::uvec2 pixel);

/// A view-space point on the screen: pixels, and device depth.
glm::dvec3 screen_point(const CameraData& camera, glm::dvec3 vs_position);
