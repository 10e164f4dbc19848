// What rays truly meet, by rays made by hand in a scene of a few rectangles.
#include "experiments/study/measuring/rays/exact_rays.h"
#include "core/error.h"
#include "variants/tracers/outcome.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(64, 48);

void add_quad(Scene& scene, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    Mesh mesh{.indices = {0, 1, 2, 0, 2, 3}};
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec3 p : {corner, corner + u, corner + u + v, corner + v})
        mesh.vertices.push_back({.position = p, .normal = normal, .tangent = {1, 0, 0, 1}, .color = glm::vec4(1)});
    scene.instances.push_back({.mesh = unsigned(scene.meshes.size()), .node = 0});
    scene.meshes.push_back(mesh);
}

constexpr glm::vec3 wall_center(0, 1.2f, -5), sheet_center(1, 0.9f, -2), side_wall_center(8, 1, -1),
    rear_wall_center(0, 2, 9);

/// A floor (y = 0) before a wall, a sheet that stands between, a wall beside the image and one behind the camera. The
/// camera looks down and is rolled, so that its space is not the world's.
Shot shot_of_walls(bool is_orthographic = false) {
    Shot shot{.config = {.extent = extent}, .scene = {.name = "walls"}, .camera = {}, .facts = {}, .steps = {}};
    shot.scene.nodes.push_back({.name = "root"});
    shot.scene.materials.push_back({.name = "plain"});
    add_quad(shot.scene, {-20, 0, 6}, {40, 0, 0}, {0, 0, -30});
    add_quad(shot.scene, wall_center - glm::vec3(3, 1.2f, 0), {6, 0, 0}, {0, 2.4f, 0});
    add_quad(shot.scene, sheet_center - glm::vec3(0.4f, 0.2f, 0), {0.8f, 0, 0}, {0, 0.4f, 0});
    add_quad(shot.scene, side_wall_center + glm::vec3(0, -1, -1), {0, 0, 2}, {0, 2, 0});
    add_quad(shot.scene, rear_wall_center + glm::vec3(2, -2, 0), {-4, 0, 0}, {0, 4, 0});
    shot.camera = {.name = "main",
                   .is_orthographic = is_orthographic,
                   .vertical_fov = 0.8f,
                   .orthographic_height = 5,
                   .keys = {{.position = {0, 2, 4}, .target = {0, 0.6f, -3}, .up = {0.2f, 1, 0}}}};
    return shot;
}

struct ExactRaysTest : testing::Test {
    Shot shot = shot_of_walls();
    CameraPose pose;
    CameraData camera;
    std::vector<RecordedRays> asked;

    ExactRaysTest() { look(); }
    void look(glm::vec2 jitter = {0, 0}) {
        pose = shot_frame(shot, 0).camera;
        camera = camera_data(pose, nullptr, {.extent = extent, .jitter = jitter});
    }

    glm::dvec2 on_screen(glm::vec3 world) const {
        const glm::dvec4 clip = glm::dmat4(camera.clip_from_world) * glm::dvec4(world, 1);
        return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(extent);
    }
    /// The pixel that shows a point near `near_this` of the floor.
    glm::uvec2 pixel_at(glm::vec3 near_this) const { return glm::uvec2(on_screen(near_this)); }
    glm::vec3 floor_at(glm::uvec2 pixel) const {
        const CameraRay ray = camera_ray(pose, extent, glm::vec2(pixel) + 0.5f);
        return ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
    }
    /// A ray of that pixel towards a point or, if w is 0, a direction. Its origin is far off: only the pixel's own
    /// surface may count.
    ExactHit hit(glm::uvec2 pixel, glm::vec4 towards) const {
        const glm::vec3 origin = floor_at(pixel), wrong_origin = origin + glm::vec3(0.3f, 0.2f, -0.1f);
        const glm::vec3 direction = glm::normalize(glm::vec3(towards) - towards.w * origin);
        // Two rays per pixel, of which the second is traced.
        RecordedRays recorded{.rays_per_pixel = 2};
        recorded.rays.resize(size_t(extent.x) * extent.y * 2);
        recorded.rays[2 * (pixel.y * extent.x + pixel.x) + 1] = {
            .origin = glm::vec3(camera.view_from_world * glm::vec4(wrong_origin, 1)),
            .is_traced = 1,
            .direction = glm::mat3(camera.view_from_world) * direction};
        const std::vector<ExactHit> hits = ExactRays(shot, 0, camera).hits(recorded);
        EXPECT_EQ(hits.size(), recorded.rays.size());
        return hits[2 * (pixel.y * extent.x + pixel.x) + 1];
    }
    ExactHit hit_of_point(glm::vec3 start, glm::vec3 point) const { return hit(pixel_at(start), glm::vec4(point, 1)); }

    /// Single precision: some 1e-6 of places up to 10 m away, and as much of the screen's 64 pixels, which a point that
    /// is off by 1e-5 m at 5 m moves on by less than a thousandth of a pixel.
    void expect_at(const ExactHit& hit, glm::vec3 start, glm::vec3 point) const {
        EXPECT_NEAR(hit.distance, glm::length(point - floor_at(pixel_at(start))), 1e-4);
        EXPECT_NEAR(hit.position.x, on_screen(point).x, 1e-3);
        EXPECT_NEAR(hit.position.y, on_screen(point).y, 1e-3);
    }
};

}  // namespace

TEST_F(ExactRaysTest, WhatTheScreenShowsIsAHit) {
    const glm::vec3 start(-0.5f, 0, -1);
    const ExactHit hit = hit_of_point(start, wall_center);
    EXPECT_EQ(hit.outcome, outcome_hit);
    expect_at(hit, start, wall_center);
    EXPECT_EQ(hit_of_point({1, 0, -0.5f}, sheet_center).outcome, outcome_hit) << "the sheet's front, from before it";
}

TEST_F(ExactRaysTest, WhatSomethingStandsBeforeIsHidden) {
    // The point of the wall that lies behind the sheet, as the camera sees it.
    const glm::vec3 eye(pose.world_from_view[3]), to_sheet = sheet_center - eye;
    const glm::vec3 behind = eye + to_sheet * ((wall_center.z - eye.z) / to_sheet.z), start(-1.5f, 0, -2);
    ASSERT_GT(behind.y, 0);
    const ExactHit hit = hit_of_point(start, behind);
    EXPECT_EQ(hit.outcome, outcome_hidden);
    expect_at(hit, start, behind);
}

TEST_F(ExactRaysTest, TheOtherSideOfWhatIsShownIsHidden) {
    const glm::vec3 start(1, 0, -3.7f);
    const ExactHit hit = hit_of_point(start, sheet_center);
    EXPECT_EQ(hit.outcome, outcome_hidden);
    expect_at(hit, start, sheet_center);
}

TEST_F(ExactRaysTest, BesideTheImageIsOffScreen) {
    const glm::vec3 start(1, 0, 0.5f);
    const ExactHit hit = hit_of_point(start, side_wall_center);
    EXPECT_EQ(hit.outcome, outcome_off_screen);
    expect_at(hit, start, side_wall_center);
    EXPECT_GT(hit.position.x, float(extent.x));
}

TEST_F(ExactRaysTest, BehindTheCameraHasADistanceOnly) {
    for (const bool is_orthographic : {false, true}) {
        shot = shot_of_walls(is_orthographic);
        look();
        const glm::vec3 start(-0.5f, 0, -1);
        const ExactHit hit = hit_of_point(start, rear_wall_center);
        EXPECT_EQ(hit.outcome, outcome_behind_camera) << is_orthographic;
        EXPECT_NEAR(hit.distance, glm::length(rear_wall_center - floor_at(pixel_at(start))), 1e-4);
    }
}

TEST_F(ExactRaysTest, WhatLeavesTheSceneEndsAtTheFarPlane) {
    const ExactHit hit = this->hit(pixel_at({0, 0, -1}), {0, 1, 0, 0});
    EXPECT_EQ(hit.outcome, outcome_background);
    EXPECT_EQ(hit.distance, pose.far);
}

TEST_F(ExactRaysTest, BelowItsSurfaceARayMeetsItsOwn) {
    EXPECT_EQ(hit(pixel_at({0, 0, -1}), {0.3f, -0.01f, -1, 0}).outcome, outcome_own_surface);
    EXPECT_NE(hit(pixel_at({0, 0, -1}), {0.3f, 0.01f, -1, 0}).outcome, outcome_own_surface);
}

TEST_F(ExactRaysTest, WithoutADirectionARayMeetsNothing) {
    EXPECT_EQ(hit(pixel_at({0, 0, -1}), {0, 0, 0, 0}).outcome, outcome_own_surface);  // 0 / 0
}

TEST_F(ExactRaysTest, AnOrthographicCameraSeesPointsAlongItsAxis) {
    shot = shot_of_walls(true);
    look();
    const glm::vec3 start(-0.5f, 0, -1);
    const ExactHit hit = hit_of_point(start, wall_center);
    EXPECT_EQ(hit.outcome, outcome_hit);
    expect_at(hit, start, wall_center);
    const glm::vec3 axis(-pose.world_from_view[2]);
    const glm::vec3 behind = sheet_center + axis * ((wall_center.z - sheet_center.z) / axis.z);
    ASSERT_GT(behind.y, 0);
    const ExactHit hidden = hit_of_point({0.2f, 0, -2.5f}, behind);
    EXPECT_EQ(hidden.outcome, outcome_hidden);
}

TEST_F(ExactRaysTest, RaysOfShiftedSamplesAreRefused) {
    look({0.25f, 0});
    try {
        ExactRays(shot, 0, camera);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "exact hits are asked for from the centres of pixels only");
    }
}
