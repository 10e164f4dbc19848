// What rays that miss see where misses = probe, through a denoiser that shows each pixel's own ray of the frame.
#include "tests/variants/denoiser_bench.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace {

struct ProbeMissesTest : TechniqueTest {
    const glm::vec3 place{1, 2, 3};  ///< of the camera, in the middle of a sphere
    static constexpr float radius = 3;

    glm::mat4 turned(float degrees, glm::vec3 axis) const {
        return glm::rotate(glm::translate(glm::mat4(1), place), glm::radians(degrees), axis);
    }
    /// More than a right angle, so that six frames show all around.
    DenoiserBench bench(const SyntheticScene& scene) {
        const CameraPose pose{.world_from_view = turned(0, {0, 1, 0}), .vertical_fov = 1.6f};
        return {device(),
                "ratio_accumulation",
                pose,
                {24, 24},
                scene,
                {{"reuse_neighbors", false}, {"temporal_accumulation", false}},
                {{"misses", "probe"}}};
    }
};

/// By brute force: where the ray meets the sphere. Of color(), 0.115 from one texel of the probe to the next, half of
/// that is more than its texels hide. Hits of a quarter of confidence see three quarters of it.
TEST_F(ProbeMissesTest, SeeWhatTheRayMeets) {
    const auto color = [](glm::vec3 direction) { return 0.5f + 0.5f * direction; };
    const auto surface = [=](const CameraRay& ray) {
        const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 0.6f, -0.2f) - ray.direction);
        return SyntheticHit{.distance = radius,
                            .normal = normal,
                            .roughness = 0,
                            .metalness = 1,
                            .specular = 1,
                            .lit = color(ray.direction)};
    };
    DenoiserBench mirrors = bench(surface);
    RayFrame rays = {.color = [](glm::uvec2) { return glm::vec3(7); }};
    rays.change = [](glm::uvec2 pixel, StoredRay& ray) {
        if (pixel.x % 2 == 0)
            ray.target = ray_missed;
        else
            ray.confidence = 0.25f;
    };
    for (const float degrees : {90.0f, -90.0f})
        mirrors.pose.world_from_view = turned(degrees, {1, 0, 0}), mirrors.next(rays);
    HostImage found;
    for (const float degrees : {180.0f, 90.0f, 0.0f, -90.0f})
        mirrors.pose.world_from_view = turned(degrees, {0, 1, 0}), found = mirrors.next(rays);
    for (unsigned y = 0; y < 24; ++y)
        for (unsigned x = 0; x < 24; ++x) {
            const CameraRay ray = camera_ray(mirrors.pose, {24, 24}, glm::vec2(x, y) + 0.5f);
            const glm::dvec3 from(radius * ray.direction), way(reflect(ray.direction, surface(ray).normal));
            double inside = 1e-3, outside = 3 * radius;
            for (int step = 0; step < 50; ++step) {
                const double middle = 0.5 * (inside + outside);
                (glm::length(from + middle * way) < radius ? inside : outside) = middle;
            }
            const glm::vec3 guessed = color(glm::vec3(glm::normalize(from + inside * way)));
            const glm::vec3 expected = x % 2 == 0 ? guessed : 0.75f * guessed + 0.25f * 7.0f;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(found.pixel(x, y)[c], expected[c], 0.115 / 2) << x << ", " << y;
            ASSERT_EQ(found.pixel(x, y)[3], 1);
        }
}

/// Below the horizon all is as bright as the environment above it: so is what rays see, whatever share of it is
/// guessed.
TEST_F(ProbeMissesTest, SeeTheEnvironmentBesideSurfaces) {
    DenoiserBench open = bench([](const CameraRay& ray) {
        if (ray.direction.y > 0) return SyntheticHit{.lit = glm::vec3(3)};
        return SyntheticHit{.distance = 1 / -ray.direction.y,
                            .normal = {0, 1, 0},
                            .roughness = 0.3f,
                            .metalness = 1,
                            .specular = 1,
                            .lit = glm::vec3(3)};
    });
    open.environment = 3;
    RayFrame rays;
    rays.change = [](glm::uvec2 pixel, StoredRay& ray) {
        ray.target = ray_missed;
        ray.direction = glm::normalize(ray.direction + glm::vec3(0.1f * float(pixel.x % 5) - 0.2f, 0, 0));
    };
    const HostImage found = open.next(rays);
    for (unsigned x = 0; x < 24; ++x)
        for (unsigned y = 13; y < 24; ++y) ASSERT_NEAR(*found.pixel(x, y), 3, 1e-4) << x << ", " << y;
}

}  // namespace
