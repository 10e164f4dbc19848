#include "core/scene/camera_planes.h"
#include "core/scene/camera.h"
#include "core/scene/depth_precision.h"
#include "core/scene/triangle_tree.h"
#include "core/scene/view_depths.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <random>

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

/// Adds a card of 2 x 2 cm that faces +z, at `place`.
void add_card(Scene& scene, glm::vec3 place) {
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-.01, -.01), glm::vec2(.01, -.01), glm::vec2(.01, .01), glm::vec2(-.01, .01)})
        mesh.vertices.push_back(
            {.position = {p, 0}, .normal = {0, 0, 1}, .tangent = {1, 0, 0, 1}, .uv = {}, .color = glm::vec4(1)});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Node node{.name = "card"};
    node.translation = place;
    node.parent_from_node[3] = glm::vec4(place, 1);
    scene.nodes.push_back(node);
    scene.instances.push_back({unsigned(scene.meshes.size()), unsigned(scene.nodes.size() - 1)});
    scene.meshes.push_back(mesh);
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

/// A card is 5 cm before the camera in one frame of a million, which is none of the nine that are looked at first.
TEST(CameraPlanes, HoldInEveryFrameOfALongPath) {
    Scene scene = floor_scene();
    SceneCamera camera = camera_at({-9, 5, 0});
    camera.keys.push_back({.frame = 999999, .position = {9, 5, 0}, .target = {9, 4.7f, -1}});
    camera.frame_count = 1000000;
    const CameraPlanes without = derive_planes(camera, scene);
    const float place = -9 + 18 * 340000.0f / 999999;
    add_card(scene, {place, 5, -0.05f});
    const CameraPlanes planes = derive_planes(camera, scene);
    EXPECT_LT(planes.near, 0.05f);
    EXPECT_GT(planes.near, 0.05f / 8);  // a quarter of the distance, and half of that in the corner of the picture
    EXPECT_EQ(planes.far, without.far);
    // Where nothing comes nearer than near allows for, planes keep their bits.
    scene.instances.pop_back();
    add_card(scene, {-3.375f, 5, -4.9f});  // between two of the nine frames, which see it beyond the floor's 5 m
    EXPECT_EQ(derive_planes(camera, scene).near, without.near);
    EXPECT_EQ(derive_planes(camera, scene).far, without.far);
}

/// The same of a card that an animation brings there, and takes 40 m away, between the frames that are looked at.
TEST(CameraPlanes, HoldInEveryFrameOfAnAnimation) {
    Scene scene = floor_scene();
    const SceneCamera camera = camera_at({0, 5, 0});
    add_card(scene, {0, 5, -6});
    scene.frame_count = 81;
    const auto moving = [&](glm::vec3 to) {
        Scene moved = scene;
        moved.animation = {{.property = AnimationChannel::Property::translation,
                            .node = 1,
                            .times = {0, 13 / 30.f, 14 / 30.f, 15 / 30.f, 80 / 30.f},
                            .values = {{0, 5, -6, 0}, {0, 5, -6, 0}, glm::vec4(to, 0), {0, 5, -6, 0}, {0, 5, -6, 0}}}};
        return derive_planes(camera, moved);
    };
    const CameraPlanes still = moving({0, 5, -6});
    EXPECT_EQ(derive_planes(camera, scene).near, still.near);
    const CameraPlanes near = moving({0, 5, -0.05f}), far = moving({0, 5, -40});
    EXPECT_LT(near.near, 0.05f);
    EXPECT_GT(near.near, 0.05f / 4);
    EXPECT_EQ(near.far, still.far);
    EXPECT_EQ(far.near, still.near);
    EXPECT_GT(far.far, 40.0f);
    EXPECT_LT(far.far, 40.5f);
    EXPECT_EQ(planes_for_all_frames({0.01f, 100}, camera, scene).near, 0.01f);
}

TEST(CameraPlanes, AllowForTheUprightPicturesOfACameraWithAnAspect) {
    SceneCamera camera = camera_at({0, 1.6f, 0});
    const float near = derive_planes(camera, floor_scene()).near;
    camera.aspect = 0.5f;
    EXPECT_EQ(derive_planes(camera, floor_scene()).near, near);
    camera.aspect = 2;
    const float edge = std::tan(glm::radians(25.0f));
    EXPECT_NEAR(derive_planes(camera, floor_scene()).near,
                near * std::sqrt((1 + 5 * edge * edge) / (1 + 20 * edge * edge)), 1e-5f);
}

TEST(TriangleTree, FindsTheDistanceOfOnePassToTheBit) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> at(-1, 1);
    Mesh mesh;
    for (unsigned i = 0; i < 900; ++i) {
        mesh.vertices.push_back({.position = {at(generator), at(generator), at(generator)}});
        mesh.indices.push_back(i);
    }
    const TriangleTree tree(mesh);
    for (int i = 0; i < 50; ++i) {
        glm::mat4 matrix(1);
        for (int c = 0; c < 4; ++c) matrix[c] = {at(generator), at(generator), at(generator), c == 3};
        const glm::vec3 point(3 * at(generator), 3 * at(generator), 3 * at(generator));
        const double distance = nearest_distance(mesh, matrix, point);
        EXPECT_EQ(tree.nearest(matrix, point, 1e9), distance);
        EXPECT_EQ(tree.nearest(matrix, point, 0.9 * distance), 0.9 * distance);
    }
}

TEST(ViewDepths, AreThoseOfThePartsWithinThePicture) {
    const auto seen = [](const Scene& scene, CameraPose camera, glm::uvec2 extent) {
        return depths_in_view(scene, pose_scene(scene, 0), camera, extent);
    };
    // A floor 1 m below an eye that looks along -z: the lower border of the picture, of slope 0.5, meets it at 2 m.
    CameraPose camera{.vertical_fov = 2 * std::atan(0.5f)};
    camera.world_from_view[3] = {0, 1, 0, 1};
    const DepthRange floor = seen(floor_scene(), camera, {160, 90});
    EXPECT_NEAR(floor.nearest, 2, 1e-6);
    EXPECT_NEAR(floor.farthest, 10, 1e-6);
    camera.is_orthographic = true, camera.orthographic_height = 4;
    EXPECT_NEAR(seen(floor_scene(), camera, {160, 90}).nearest, 0, 1e-6);
    camera.orthographic_height = 1.9f;  // it ends 5 cm above the floor
    EXPECT_TRUE(seen(floor_scene(), camera, {160, 90}).is_empty());
    Scene card;
    add_card(card, {0, 1, 3});
    EXPECT_TRUE(seen(card, camera, {160, 90}).is_empty());  // behind the eye
    // The author's frame of 2:1 in a square picture: twice as high, so that the floor is met at 1 m.
    camera.is_orthographic = false, camera.aspect = 2;
    EXPECT_NEAR(seen(floor_scene(), camera, {90, 90}).nearest, 1, 1e-6);
}

/// Neighbouring codes, from the projection's closed form: d = far (z - near) / (z (far - near)).
TEST(DepthPrecision, StepsAreThoseOfTheFormat) {
    const auto step = [](float near, float far, DepthDirection direction, DepthFormat format, double depth,
                         bool is_orthographic = false) {
        const CameraPose pose{.is_orthographic = is_orthographic, .near = near, .far = far};
        return depth_step(camera_data(pose, nullptr, {.extent = {16, 9}, .depth_direction = direction}), format, depth);
    };
    const auto standard = DepthDirection::standard, reversed = DepthDirection::reversed;
    // 2^-24 z^2 / near for float32 below 1; the file of 0.0001 and 1e10 m has steps of 18 % at 300 m.
    EXPECT_NEAR(step(1e-4f, 1e10f, standard, DepthFormat::d32f, 300), 0x1p-24 * 300 * 300 / 1e-4, 0.1);
    EXPECT_LT(step(1e-4f, 1e10f, reversed, DepthFormat::d32f, 300), 300 * 0x1p-22);
    EXPECT_NEAR(step(0.1f, 100, standard, DepthFormat::d16, 50), 50 * 50 / 0.1 * (99.9 / 100) / 65535, 1e-4);
    EXPECT_NEAR(step(0.1f, 100, reversed, DepthFormat::d24, 50), 50 * 50 / 0.1 * (99.9 / 100) / 16777215, 1e-6);
    EXPECT_NEAR(step(0, 100, standard, DepthFormat::d16, 50, true), 100.0 / 65535, 1e-6);
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
