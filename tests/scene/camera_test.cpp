#include "core/scene/camera.h"
#include "core/shared/environment.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

CameraPose tilted(bool is_orthographic) {
    const glm::vec3 z = glm::normalize(glm::vec3(0.3f, 0.5f, 1.0f)),
                    x = glm::normalize(glm::cross(glm::vec3(0, 1, 0), z));
    CameraPose pose{.is_orthographic = is_orthographic,
                    .vertical_fov = 0.9f,
                    .orthographic_height = 3.0f,
                    .near = 0.05f,
                    .far = 80.0f};
    pose.world_from_view =
        glm::mat4(glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(1, 2, 3, 1));
    return pose;
}

}  // namespace

TEST(Camera, RaysMeetTheirPixels) {
    const glm::uvec2 extent(481, 271);
    for (const bool is_orthographic : {false, true})
        for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
            const CameraPose pose = tilted(is_orthographic);
            const CameraData data = camera_data(pose, nullptr, {.extent = extent, .depth_direction = direction});
            for (const glm::vec2 pixel : {glm::vec2(0.5f, 0.5f), glm::vec2(480.5f, 270.5f), glm::vec2(100.5f, 200.5f)})
                for (const double distance : {0.1, 3.0, 70.0}) {
                    const CameraRay ray = camera_ray(pose, extent, pixel);
                    const glm::dvec4 clip =
                        glm::dmat4(data.clip_from_view) * glm::dmat4(data.view_from_world) *
                        glm::dvec4(glm::dvec3(ray.origin) + distance * glm::dvec3(ray.direction), 1.0);
                    const glm::dvec2 found = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(extent);
                    // float32 matrices and rays: 2^-23 of a world coordinate of 3 m, seen from 0.1 m in 481 pixels, is
                    // some 1e-3.
                    EXPECT_NEAR(found.x, pixel.x, 2e-3);
                    EXPECT_NEAR(found.y, pixel.y, 2e-3);
                }
        }
}

/// glTF 2.0, 3.10.3.2 to 3.10.3.4: the frame of 16:9 that its author saw is never cropped.
TEST(Camera, GrowsInHeightWhereTheImageIsNarrowerThanItsFrame) {
    for (const bool is_orthographic : {false, true}) {
        CameraPose pose = tilted(is_orthographic);
        const double half_height = is_orthographic ? 1.5 : std::tan(0.45);
        pose.aspect = 16.0f / 9;
        for (const glm::uvec2 extent : {glm::uvec2(640, 360), {1600, 400}, {400, 400}, {90, 160}}) {
            const double aspect = double(extent.x) / extent.y, width = half_height * std::max(16.0 / 9, aspect);
            const glm::mat4 clip = clip_from_view(pose, float(aspect), DepthDirection::standard);
            EXPECT_NEAR(1 / std::abs(double(clip[0][0])), width, 1e-5 * width);
            EXPECT_NEAR(1 / std::abs(double(clip[1][1])), width / aspect, 1e-5 * width);
            const CameraData data = camera_data(pose, nullptr, {.extent = extent});
            EXPECT_EQ(data.clip_from_view, clip);
            const CameraRay ray = camera_ray(pose, extent, glm::vec2(0));  // the upper left corner
            const glm::dvec3 corner = glm::dmat4(data.view_from_world) *
                                      glm::dvec4(glm::dvec3(ray.origin) + 4.0 * glm::dvec3(ray.direction), 1.0);
            const double scale = is_orthographic ? 1 : -corner.z;
            EXPECT_NEAR(corner.x, -width * scale, 1e-4);
            EXPECT_NEAR(corner.y, width / aspect * scale, 1e-4);
        }
        CameraPose unnamed = pose;
        unnamed.aspect = 0;
        EXPECT_EQ(fitted(pose, 2.0).vertical_fov, unnamed.vertical_fov);  // to the bit
        EXPECT_EQ(clip_from_view(pose, 16.0f / 9, DepthDirection::standard),
                  clip_from_view(unnamed, 16.0f / 9, DepthDirection::standard));
    }
}

TEST(Camera, DepthRunsFromNearToFar) {
    for (const bool is_orthographic : {false, true}) {
        const CameraPose pose = tilted(is_orthographic);
        const auto depth_at = [&](DepthDirection direction, float z) {
            const glm::vec4 clip = clip_from_view(pose, 1.5f, direction) * glm::vec4(0, 0, -z, 1);
            return clip.z / clip.w;
        };
        EXPECT_NEAR(depth_at(DepthDirection::standard, pose.near), 0.0f, 1e-5f);
        EXPECT_NEAR(depth_at(DepthDirection::standard, pose.far), 1.0f, 1e-5f);
        EXPECT_NEAR(depth_at(DepthDirection::reversed, pose.near), 1.0f, 1e-5f);
        EXPECT_NEAR(depth_at(DepthDirection::reversed, pose.far), 0.0f, 1e-5f);
        for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
            const CameraData data = camera_data(pose, nullptr, {.extent = {150, 100}, .depth_direction = direction});
            // Near the far plane a step of standard float depth, 6e-8, is z^2 / near * 6e-8 = 2e-3 m at 40 m.
            EXPECT_NEAR(view_distance(data, depth_at(direction, 40.0f)), 40.0f, 1e-2f);
        }
    }
}

TEST(Camera, YPointsDownOnTheScreen) {
    CameraPose pose;
    const glm::vec4 above = clip_from_view(pose, 1.0f, DepthDirection::standard) * glm::vec4(0, 1, -2, 1);
    EXPECT_LT(above.y / above.w, 0.0f);
    EXPECT_GT(camera_ray(pose, {100, 100}, {50, 10}).direction.y, 0.0f);
}

TEST(EnvironmentMapping, IsThatOfTheReadme) {
    // u = 0.5 + atan2(z, x) / (2 pi), v = acos(y) / pi.
    EXPECT_NEAR(environment_uv(glm::vec3(1, 0, 0), 0.0f).x, 0.5f, 1e-6f);
    EXPECT_NEAR(environment_uv(glm::vec3(0, 0, 1), 0.0f).x, 0.75f, 1e-6f);
    EXPECT_NEAR(environment_uv(glm::vec3(0, 1, 0), 0.0f).y, 0.0f, 1e-6f);
    EXPECT_NEAR(environment_uv(glm::vec3(0, -1, 0), 0.0f).y, 1.0f, 1e-6f);
    // Turned by 90 degrees about +Y, what stood at +X stands at -Z.
    EXPECT_NEAR(environment_uv(glm::vec3(0, 0, -1), glm::radians(90.0f)).x, 0.5f, 1e-6f);
}

TEST(EnvironmentRadiance, FiltersBilinearlyAndWraps) {
    Environment environment{.type = Environment::Type::image};
    environment.latlong = HostImage({4, 2}, 3);
    for (unsigned x = 0; x < 4; ++x)
        for (unsigned y = 0; y < 2; ++y) environment.latlong.pixel(x, y)[0] = float(x);
    // u = 0 lies between the last and the first texel.
    EXPECT_NEAR(environment.radiance({-1, 0, -1e-7f}).x, 1.5f, 1e-3f);
    EXPECT_NEAR(environment.radiance({std::cos(0.25f * 3.14159265f), 0, std::sin(0.25f * 3.14159265f)}).x, 2.0f,
                1e-4f);  // u = 0.625: centre of texel 2
}
