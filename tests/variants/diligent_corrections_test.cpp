// Each correction of the rays, on a G-buffer that shows what it fixes; those of the march and of the rays' directions
// have tests of their own.
#include "tests/variants/diligent_hits.h"

#include <cmath>

namespace {

using DiligentCorrections = DiligentHits;

/// The original's projection knows of the jitter, its unprojection does not, which turns its rays by an angle that
/// grows with the scene.
TEST_F(DiligentCorrections, UnprojectJitterHoldsInScenesOfAnySize) {
    const nlohmann::json corrected = {{"hierarchy.unproject_jitter", true}};
    const HostGBuffer unjittered = gbuffer_of(floor_before_white);
    EXPECT_EQ(trace(unjittered, corrected).direction.values, trace(unjittered).direction.values);
    view.jitter = {0.45f, -0.4f};
    for (const float scale : {1.0f, 100.0f}) {
        const CameraPose small = pose;
        enlarge(scale);
        EXPECT_GT(quality(corrected, scale).right, 0.999) << scale;
        pose = small;
    }
    enlarge(100);
    EXPECT_LT(quality(nlohmann::json::object(), 100).hits, 0.01);
}

/// A metre of 100 km is lost in the rounding of float32.
TEST_F(DiligentCorrections, RelativeRayStepHoldsInScenesOfAnySize) {
    const nlohmann::json corrected = {{"hierarchy.relative_ray_step", true}};
    EXPECT_GT(quality(corrected).right, 0.999);
    enlarge(16384);
    EXPECT_GT(quality(corrected, 16384).right, 0.999);
    EXPECT_LT(quality(nlohmann::json::object(), 16384).right, 0.6);
}

/// Steps along the mirrored rays end behind the camera.
TEST_F(DiligentCorrections, ClipRayToNearPlaneFindsWhatLiesTowardsTheCamera) {
    pose = {.vertical_fov = 1.9f, .near = 0.1f, .far = 100.0f};
    view.extent = {120, 120};
    const HostGBuffer gbuffer = gbuffer_of(mirror_beside_wall);
    EXPECT_EQ(confidence_of(trace(gbuffer)), 0);
    EXPECT_GT(confidence_of(trace(gbuffer, {{"hierarchy.clip_ray_to_near_plane", true}})), 300);
}

/// A geometric normal that the shading normal turns rays below of.
TEST_F(DiligentCorrections, InwardRaysMissOrBringNoLight) {
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    for (size_t i = 0; i < gbuffer.normal.pixel_count(); ++i)
        gbuffer.geometric_normal.set_rgb(i, glm::normalize(glm::vec3(0, 0.05f, 1)));
    EXPECT_GT(confidence_of(trace(gbuffer)), 3000);
    const DiligentTraced missed = trace(gbuffer, {{"inward_rays", "missed"}}),
                         black = trace(gbuffer, {{"inward_rays", "black"}});
    unsigned inward = 0;
    for (size_t i = 0; i < gbuffer.normal.pixel_count(); ++i) {
        const glm::vec3 direction = missed.direction.rgb(i);
        if (direction == glm::vec3(0) || glm::dot(direction, gbuffer.geometric_normal.rgb(i)) > 0) continue;
        ++inward;
        EXPECT_EQ(missed.radiance.values[4 * i + 3], 0) << i;
        EXPECT_EQ(black.radiance.values[4 * i + 3], 1) << i;
        EXPECT_EQ(black.radiance.rgb(i), glm::vec3(0)) << i;
    }
    EXPECT_GT(inward, 3000u);
    EXPECT_LT(confidence_of(missed), 300);
}

TEST_F(DiligentCorrections, RejectUnfinishedIgnoresWhereRaysAreGivenUp) {
    pose.world_from_view = glm::mat4(1);
    const HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    const nlohmann::json few_steps = {{"hierarchy.max_traversal_intersections", 3},
                                      {"hierarchy.relative_depth_buffer_thickness", 1.0}};
    nlohmann::json rejected = few_steps;
    rejected["hierarchy.reject_unfinished"] = true;
    EXPECT_GT(confidence_of(trace(gbuffer, few_steps)), 100);
    EXPECT_EQ(confidence_of(trace(gbuffer, rejected)), 0);
}

TEST_F(DiligentCorrections, AcceptContactHitsShowsTheWallInTheFirstRowsOfTheFloor) {
    pose.world_from_view = glm::mat4(1);
    const HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    const double original = confidence_of(trace(gbuffer)),
                 corrected = confidence_of(trace(gbuffer, {{"hierarchy.accept_contact_hits", true}}));
    // One row at least: the two nearest the wall reflect the two above them. At both sides hits fade.
    EXPECT_GT(corrected, original + 0.9 * view.extent.x);
}

TEST_F(DiligentCorrections, PremultiplyConfidenceWeightsTheirColour) {
    const HostGBuffer gbuffer = gbuffer_of(mirror_floor);
    const HostImage original = trace(gbuffer).radiance,
                    corrected = trace(gbuffer, {{"premultiply_confidence", true}}).radiance;
    unsigned faded = 0;
    for (size_t i = 0; i < original.pixel_count(); ++i) {
        const float confidence = original.values[4 * i + 3];
        EXPECT_EQ(corrected.values[4 * i + 3], confidence);
        EXPECT_EQ(corrected.rgb(i), confidence * original.rgb(i));
        faded += confidence > 0 && confidence < 0.9f;
    }
    EXPECT_GT(faded, 100u);
}

/// A scene in which rays are 100 km long and more; the largest half is 65504.
TEST_F(DiligentCorrections, FloatRaysKeepLongDistances) {
    const float scale = 65536;
    enlarge(scale);
    const auto wrong_share = [&](bool is_float) {
        const HostImage found =
            trace(gbuffer_of(scaled(scale)), {{"hierarchy.relative_ray_step", true}, {"float_rays", is_float}})
                .direction;
        unsigned rays = 0, wrong = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const std::optional<Mirrored> expected = mirrored(x, y, scale);
                const glm::vec2 extent(view.extent);
                if (!expected || expected->distance < 1e5f || fade_at(expected->pixel / extent, extent) < 1) continue;
                const float* d = found.pixel(x, y);
                ++rays;
                wrong += !(std::abs(glm::length(glm::vec3(d[0], d[1], d[2])) - expected->distance) <
                           0.01f * expected->distance);
            }
        EXPECT_GT(rays, 100u);
        return double(wrong) / rays;
    };
    EXPECT_LT(wrong_share(true), 0.01);
    EXPECT_GT(wrong_share(false), 0.9);
}

}  // namespace
