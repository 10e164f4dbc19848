// Each correction of the tracer, on a G-buffer that shows what it fixes.
#include "tests/variants/amd_golden.h"
#include "tests/variants/brute_force_hierarchy.h"
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace {

struct AmdCorrections : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {96, 120}};
    HostImage noise{{128, 128}, 2, 0.5f};

    HostGBuffer gbuffer_of(const SyntheticScene& scene) { return host_gbuffer(device(), pose, view, scene); }

    /// rgb: (lit at the hit, blended by its confidence with a black environment); w: length (m).
    HostImage trace(const HostGBuffer& gbuffer, nlohmann::json parameters) {
        parameters["hierarchy.min_traversal_occupancy"] = 0;
        parameters["samples_per_quad"] = 4;
        return amd_trace_frame(device(), gbuffer, parameters, noise).radiance;
    }
    HostImage trace(const SyntheticScene& scene, const nlohmann::json& parameters) {
        return trace(gbuffer_of(scene), parameters);
    }
};

/// Sum of the confidences where all that is lit radiates 1.
double sum_of(const HostImage& radiance) {
    double sum = 0;
    for (size_t i = 0; i < radiance.pixel_count(); ++i) sum += radiance.values[4 * i];
    return sum;
}

/// 120 rows are 7.5 texels of the pyramid's fourth level, as 1080 are 67.5: it has no texels for the last 8 rows, to
/// which the ceiling's rays go.
TEST_F(AmdCorrections, PartialTexelsAsTheNearPlaneShowWhatOddLevelsLackWithReversedDepth) {
    pose.world_from_view = glm::translate(glm::mat4(1), {0, 0.8f, 0});
    const double standard = sum_of(trace(ceiling_before_white, nlohmann::json::object()));
    view.depth_direction = DepthDirection::reversed;
    const double reversed = sum_of(trace(ceiling_before_white, nlohmann::json::object()));
    const double corrected = sum_of(trace(ceiling_before_white, {{"hierarchy.partial_texels", "near_plane"}}));
    EXPECT_LT(reversed, 0.9 * standard);
    EXPECT_NEAR(corrected, standard, 0.01 * standard);
}

/// A floor that fills the image, whose rays leave upwards. 64 divides the height, so that all levels have a border at
/// the top, which rays overstep by 0.005 pixels. In reversed depth what lies off the screen is far away, and the
/// original goes on until its steps are used up.
TEST_F(AmdCorrections, StopOutsideScreenEndsRaysAtTheBorder) {
    view = {.extent = {64, 128}, .depth_direction = DepthDirection::reversed};
    pose.world_from_view = glm::rotate(glm::mat4(1), -0.85f, glm::vec3(1, 0, 0));
    const HostGBuffer gbuffer = gbuffer_of(floor_below_nothing);
    const auto mean_height = [&](bool stops) {
        const HostImage found =
            trace(gbuffer, {{"hierarchy.stop_outside_screen", stops}, {"hierarchy.clip_ray_to_near_plane", true}});
        double sum = 0;
        for (unsigned y = 0; y < view.extent.y; ++y) {
            const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(31, y) + 0.5f);
            const glm::dvec3 mirrored(ray.direction * glm::vec3(1, -1, 1));
            const glm::dvec3 vs_ray = glm::dmat3(gbuffer.camera.view_from_world) * mirrored;
            const glm::dvec3 end =
                view_point(gbuffer.depth, gbuffer.camera, {31, y}) + double(found.pixel(31, y)[3]) * vs_ray;
            sum += screen_point(gbuffer.camera, end).y;
        }
        return sum / view.extent.y;
    };
    EXPECT_NEAR(mean_height(true), -0.005, 0.002);
    EXPECT_LT(mean_height(false), -10);
}

TEST_F(AmdCorrections, ClipRayToNearPlaneFindsWhatLiesTowardsTheCamera) {
    pose.vertical_fov = 1.9f;
    view.extent = {120, 120};
    const nlohmann::json thick = {{"hierarchy.depth_buffer_thickness", 0.1}};
    nlohmann::json clipped = thick;
    clipped["hierarchy.clip_ray_to_near_plane"] = true;
    const double original = sum_of(trace(mirror_beside_wall, thick)),
                 corrected = sum_of(trace(mirror_beside_wall, clipped));
    EXPECT_GT(corrected, 2 * original + 100);
}

TEST_F(AmdCorrections, AcceptContactHitsShowsTheWallInTheFirstRowsOfTheFloor) {
    const double original = sum_of(trace(floor_before_white, nlohmann::json::object()));
    const double corrected = sum_of(trace(floor_before_white, {{"hierarchy.accept_contact_hits", true}}));
    // One row of 96 pixels at least: the two nearest the wall reflect the two above them.
    EXPECT_GT(corrected, original + 0.9 * view.extent.x);
}

TEST_F(AmdCorrections, RejectUnfinishedIgnoresWhereRaysAreGivenUp) {
    const nlohmann::json few_steps = {{"hierarchy.max_traversal_intersections", 3},
                                      {"hierarchy.depth_buffer_thickness", 100.0}};
    nlohmann::json rejected = few_steps;
    rejected["hierarchy.reject_unfinished"] = true;
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    gbuffer.lit = HostImage(gbuffer.extent(), 4, 1.0f);
    const double original = sum_of(trace(gbuffer, few_steps)), corrected = sum_of(trace(gbuffer, rejected));
    EXPECT_GT(original, 100);
    EXPECT_EQ(corrected, 0);
}

TEST_F(AmdCorrections, FarMissesAreAsLongAsTheFarPlaneIsAway) {
    const HostGBuffer gbuffer = gbuffer_of(floor_below_nothing);
    const HostImage original = trace(gbuffer, nlohmann::json::object()),
                    corrected = trace(gbuffer, {{"far_misses", true}});
    for (size_t i = 0; i < original.pixel_count(); ++i) {
        if (gbuffer.depth.values[i] == 1) continue;
        ASSERT_EQ(original.values[4 * i], 0);
        EXPECT_NE(original.values[4 * i + 3], 100);
        EXPECT_EQ(corrected.values[4 * i + 3], 100);
    }
}

TEST_F(AmdCorrections, GuardMirrorNormalHoldsForEveryRandomNumber) {
    const HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    const HostImage expected = trace(gbuffer, {{"guard_mirror_normal", true}});
    EXPECT_GT(sum_of(expected), 1000);
    noise = HostImage({128, 128}, 2, 1.0f);
    EXPECT_EQ(trace(gbuffer, {{"guard_mirror_normal", true}}).values, expected.values);
    for (const float value : trace(gbuffer, nlohmann::json::object()).values) EXPECT_TRUE(std::isfinite(value));
}

/// In the middle of 97 columns rays stay in their column exactly. Unless they are nudged the distance to the next
/// column is 0 * infinity, which lavapipe's min() passes over as processors do, while Vulkan leaves it open: the same
/// image.
TEST_F(AmdCorrections, ZeroDirectionNudgedTracesAlongColumns) {
    view.extent = {97, 120};
    const HostImage found = trace(floor_before_white, {{"hierarchy.zero_direction", "nudged"}});
    if (device().info().is_cpu()) {
        EXPECT_TRUE(found.values == trace(floor_before_white, {{"hierarchy.zero_direction", "whole_vector"}}).values);
    }
    double column = 0, beside = 0;
    for (unsigned y = 0; y < 120; ++y) {
        column += found.pixel(48, y)[0];
        beside += found.pixel(47, y)[0];
    }
    EXPECT_GT(column, 20);
    EXPECT_NEAR(column, beside, 1);
}

/// A geometric normal that the shading normal turns rays below of, before a wall of 1 and an environment of 0.5.
TEST_F(AmdCorrections, InwardRaysMissOrBringNoLight) {
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    gbuffer.fallback = HostImage(gbuffer.extent(), 4, 0.5f);
    for (size_t i = 0; i < gbuffer.normal.pixel_count(); ++i)
        gbuffer.geometric_normal.set_rgb(i, glm::normalize(glm::vec3(0, 0.05f, 1)));
    for (const auto& [choice, expected] : {std::pair("traced", 1.0f), {"missed", 0.5f}, {"black", 0.0f}}) {
        const HostImage found = trace(gbuffer, {{"inward_rays", choice}});
        for (unsigned x = 20; x < view.extent.x - 20; ++x)                  // towards the border hits fade
            EXPECT_NEAR(found.pixel(x, 90)[0], expected, 1e-4f) << choice;  // confidences are within 4e-5 of 1
    }
}

/// Where everything radiates 1, black are the rays that are drawn into the surface: of a rough floor seen at a slant
/// several in a hundred, and none where directions are drawn again.
TEST_F(AmdCorrections, RedrawBelowHorizonLeavesNoRayInTheSurface) {
    std::mt19937 random(5);
    for (float& number : noise.values) number = float(random() % 256) / 255;
    HostGBuffer gbuffer = gbuffer_of([](const CameraRay& ray) {
        SyntheticHit hit = mirror_floor(ray);
        if (hit.metalness > 0) hit.roughness = 0.44f;
        return hit;
    });
    for (HostImage* white : {&gbuffer.lit, &gbuffer.fallback}) *white = HostImage(gbuffer.extent(), 4, 1.0f);
    const auto black = [&](bool redraws) {
        const HostImage found = trace(gbuffer, {{"inward_rays", "black"}, {"redraw_below_horizon", redraws}});
        unsigned count = 0;
        for (size_t i = 0; i < found.pixel_count(); ++i)
            count += gbuffer.base_color.values[4 * i + 3] > 0 && found.values[4 * i] == 0;
        return count;
    };
    EXPECT_GT(black(false), 100u);
    EXPECT_EQ(black(true), 0u);
}

/// The camera looks down on the wall, so that depth varies between its rows.
TEST_F(AmdCorrections, ThicknessAtHitMipKeepsTheConfidenceOfSlantedSurfaces) {
    pose.world_from_view = glm::rotate(glm::mat4(1), -0.4f, glm::vec3(1, 0, 0));
    const double original = sum_of(trace(floor_before_white, nlohmann::json::object()));
    const double corrected = sum_of(trace(floor_before_white, {{"hierarchy.thickness_at_hit_mip", true}}));
    EXPECT_GT(corrected, 1.2 * original);
}

TEST_F(AmdCorrections, FloatRoughnessKeepsSmallWidths) {
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    for (size_t i = 3; i < gbuffer.normal.values.size(); i += 4) gbuffer.normal.values[i] = 0.03125f;
    const auto alpha = [&](const nlohmann::json& parameters) {
        return *amd_classify_frame(device(), gbuffer, parameters).roughness.pixel(48, 100);
    };
    EXPECT_EQ(alpha(nlohmann::json::object()), 0);
    EXPECT_EQ(alpha({{"float_roughness", true}}), 0x1p-10f);
}

}  // namespace
