#include "core/scene/camera_planes.h"
#include "core/scene/camera.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace {
/// A floor of 20 x 20 m at y = 0, whose corners are all far from the eyes above its middle.
Scene floor_scene() {
    Scene scene;
    scene.nodes = {{.name = "floor"}};
    scene.instances = {{0, 0}};
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-10, -10), glm::vec2(10, -10), glm::vec2(10, 10), glm::vec2(-10, 10)})
        mesh.vertices.push_back(
            {.position = {p.x, 0, p.y}, .normal = {0, 1, 0}, .tangent = {1, 0, 0, 1}, .uv = {}, .color = glm::vec4(1)});
    mesh.indices = {0, 2, 1, 0, 3, 2};
    scene.meshes = {mesh};
    return scene;
}

SceneCamera camera_at(glm::vec3 position) {
    SceneCamera camera{.vertical_fov = glm::radians(50.0f)};
    camera.keys = {{.position = position, .target = position + glm::vec3(0, -0.3f, -1)}};
    return camera;
}
}  // namespace

TEST(CameraPlanes, CutNothingThatIsSeen) {
    const Scene scene = floor_scene();
    for (const float height : {0.005f, 1.6f, 300.0f}) {
        SceneCamera camera = camera_at({0, height, 0});
        const CameraPlanes planes = derive_planes(camera, scene);
        camera.near = planes.near, camera.far = planes.far;
        const CameraPose pose = pose_camera(camera, pose_scene(scene, 0), 0);
        for (unsigned y = 0; y <= 100; y += 10)
            for (unsigned x = 0; x <= 200; x += 20) {
                const CameraRay ray = camera_ray(pose, {200, 100}, {x, y});
                const glm::vec3 hit = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
                if (ray.direction.y >= 0 || std::max(std::abs(hit.x), std::abs(hit.z)) > 10) continue;
                const float depth = -(glm::inverse(pose.world_from_view) * glm::vec4(hit, 1)).z;
                EXPECT_GT(depth, planes.near);
                EXPECT_LT(depth, planes.far);
            }
        EXPECT_GT(planes.near, 0.2f * height);  // nor are they wider than need be
        EXPECT_LT(planes.far, 1.1f * std::sqrt(200.0f + height * height));
    }
}

TEST(CameraPlanes, LookAlongThePathAndAtWhatMoves) {
    Scene scene = floor_scene();
    SceneCamera camera = camera_at({0, 8, 0});
    const float still = derive_planes(camera, scene).near;
    camera.keys.push_back({.frame = 100, .position = {0, 2, 0}, .target = {0, 1.5f, -1}});
    camera.frame_count = 101;
    EXPECT_NEAR(derive_planes(camera, scene).near, still / 4, 1e-4f * still);
    camera.keys.pop_back();
    scene.animation = {
        {.property = AnimationChannel::Property::translation, .times = {0, 1}, .values = {{0, 0, 0, 0}, {0, 6, 0, 0}}}};
    scene.frame_count = 31;
    EXPECT_NEAR(derive_planes(camera, scene).near, still / 4, 1e-4f * still);
}

TEST(CameraPlanes, HoldWithoutGeometry) {
    const CameraPlanes planes = derive_planes(camera_at({0, 0, 0}), Scene{});
    EXPECT_EQ(planes.near, 0.1f);
    EXPECT_EQ(planes.far, 100.0f);
}

TEST(CameraNodes, ScaleAndMirroringDoNotReachTheView) {
    ScenePose pose;
    glm::mat4 node(1.0f);
    node[0] *= -3.0f, node[1] *= 2.0f, node[2] *= 0.5f;
    node[3] = {1, 2, 3, 1};
    pose.world_from_node = {node};
    const CameraPose camera = pose_camera({.node = 0}, pose, 0);
    EXPECT_EQ(camera.world_from_view[3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(glm::vec3(camera.world_from_view[2]), glm::vec3(0, 0, 1));
    EXPECT_NEAR(glm::determinant(glm::mat3(camera.world_from_view)), 1.0f, 1e-6f);
}
