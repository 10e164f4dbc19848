#pragma once
#include "tests/variants/frostbite_filter_bench.h"

/// What the tests of Frostbite's temporal filter look at.
inline SyntheticHit wall_of_mirror(const CameraRay& ray) {
    return {.distance = -5.0f / ray.direction.z, .normal = {0, 0, 1}, .roughness = 0.2f, .metalness = 1, .specular = 1};
}

struct FrostbiteFilterTest : TechniqueTest {
    const nlohmann::json history_alone = {{"history_weight", 1.0}, {"neighborhood_clamp", false}};
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {96, 64}};

    CameraRay ray_of(const CameraPose& camera, unsigned x, unsigned y) const {
        return camera_ray(camera, view.extent, glm::vec2(x, y) + 0.5f + view.jitter);
    }
    /// Of the unit that averages have: colour times confidence, and confidence.
    static glm::vec4 weighed(const float* pixel) {
        return {pixel[0] * pixel[3], pixel[1] * pixel[3], pixel[2] * pixel[3], pixel[3]};
    }
};
