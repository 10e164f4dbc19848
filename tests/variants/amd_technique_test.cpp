#include "tests/variants/amd_scenes.h"
#include "tests/variants/held_camera.h"

#include <cmath>

namespace {

constexpr glm::uvec2 extent{160, 120};

using Frame = HeldCamera::Frame;

struct AmdSssrTechnique : HeldCamera {
    using HeldCamera::render;
    Frame render(const nlohmann::json& parameters, const std::string& preset, const SyntheticScene& scene,
                 unsigned count = 1, float environment = 0) {
        return render(*make_technique("amd_sssr", parameters, preset), scene, count, environment);
    }
};

// Where mirror rays end.

/// mirror_floor whose wall radiates its own coordinates: (x, y, 1).
SyntheticHit floor_before_coordinates(const CameraRay& ray) {
    SyntheticHit hit = mirror_floor(ray);
    const glm::vec3 p = ray.origin + hit.distance * ray.direction;
    if (hit.metalness == 0) hit.lit = {p.x, p.y, 1};
    return hit;
}

glm::vec2 pixel_from_world(const CameraData& camera, glm::vec3 p) {
    const glm::vec4 clip = camera.clip_from_world * glm::vec4(p, 1);
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(camera.extent);
}

struct AmdMirrorFloor : AmdSssrTechnique {
    /// Compares what each floor pixel reflects with the point of the wall that its exact mirror ray meets, in pixels:
    /// at most `farthest` away along each axis, `mean_distance` as a mean vector.
    void expect_true_hits(const std::string& preset, float farthest, double mean_distance) {
        const Frame frame =
            render({{"denoise", false}, {"float_histories", true}, {"hierarchy.depth_buffer_thickness", 0.5}}, preset,
                   floor_before_coordinates);
        const CameraData camera = camera_data(pose, nullptr, view);
        unsigned count = 0, missed = 0, wrong = 0;
        glm::dvec2 mean(0);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f + view.jitter);
                const SyntheticHit first = mirror_floor(ray);
                EXPECT_EQ(*frame.confidence.pixel(x, y), first.metalness);
                if (first.metalness == 0) continue;
                const glm::vec3 p = ray.origin + first.distance * ray.direction,
                                d = ray.direction * glm::vec3(1, -1, 1);
                const glm::vec2 expected = pixel_from_world(camera, p + (-6 - p.z) / d.z * d);
                const glm::vec2 border = 0.06f * glm::vec2(extent.y);  // beyond 5 % of the height hits do not fade
                if (glm::any(glm::lessThan(expected, border)) ||
                    glm::any(glm::greaterThan(expected, glm::vec2(extent) - border)) || p.z < -5.5f)
                    continue;
                ++count;
                const float* found = frame.radiance.pixel(x, y);
                if (found[2] < 0.9f) {
                    ++missed;
                    continue;
                }
                const glm::vec2 error =
                    pixel_from_world(camera, {found[0] / found[2], found[1] / found[2], -6}) - expected;
                wrong += std::abs(error.x) > farthest || std::abs(error.y) > farthest;
                mean += error;
            }
        EXPECT_GT(count, 1000u);
        EXPECT_LE(missed, count / 200);
        EXPECT_LE(wrong, count / 200);
        EXPECT_LT(glm::length(mean / double(count)), mean_distance);
    }
};

/// The nearest texel is half a pixel away at most; the mean is 0 unless samples are taken to lie elsewhere than they
/// do: the jitters would show as 0.5.
TEST_F(AmdMirrorFloor, ShowsWhatItsRaysMeet) {
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed})
        for (const glm::vec2 jitter : {glm::vec2(0), glm::vec2(0.4f, -0.35f)})
            for (const char* preset : {"sdk_1_5", "slides", "corrected"}) {
                SCOPED_TRACE(testing::Message() << preset << ", reversed " << (direction == DepthDirection::reversed)
                                                << ", jitter " << jitter.x);
                view.depth_direction = direction;
                view.jitter = jitter;
                expect_true_hits(preset, 0.55f, 0.05);
            }
}

/// Seen at a slant the wall is a stair of texels, whose steps rays meet up to a pixel early.
TEST_F(AmdMirrorFloor, ShowsItToAnOrthographicCamera) {
    pose.is_orthographic = true;
    pose.orthographic_height = 5;
    pose.world_from_view = glm::rotate(glm::translate(glm::mat4(1), {0, 2.5f, 3}), -0.5f, glm::vec3(1, 0.1f, 0.2f));
    for (const char* preset : {"sdk_1_5", "corrected"}) expect_true_hits(preset, 1.05f, 0.4);
}

/// A held mirror keeps, through filters and history, what it shows: the wall's 0.25 below y = 1 and 1 above. Only
/// pixels that average with nothing else are looked at: filters reach 4 pixels, tile averages 16.
TEST_F(AmdSssrTechnique, KeepsWhatAMirrorShows) {
    view.extent = {320, 240};
    // With contact hits, whose rows are black without them and reach far by the tiles' averages.
    const Frame frame = render({{"hierarchy.depth_buffer_thickness", 0.5}, {"hierarchy.accept_contact_hits", true}},
                               "corrected", mirror_floor, 4);
    const CameraData camera = camera_data(pose, nullptr, view);
    const auto rows_between = [&](glm::vec3 a, glm::vec3 b) {
        return std::abs(pixel_from_world(camera, a).y - pixel_from_world(camera, b).y);
    };
    unsigned below = 0, above = 0;
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 16; x < view.extent.x - 16; ++x) {
            const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(x, y) + 0.5f);
            const SyntheticHit first = mirror_floor(ray);
            if (first.metalness == 0) continue;
            const glm::vec3 p = ray.origin + first.distance * ray.direction;
            const glm::vec3 d = ray.direction * glm::vec3(1, -1, 1), met = p + (-6 - p.z) / d.z * d;
            const bool is_near_wall = rows_between(p, {p.x * -6 / p.z, -1, -6}) < 18;
            const bool is_near_change = rows_between(met, {met.x, 1, -6}) < 18;
            const glm::vec2 pixel = pixel_from_world(camera, met),
                            border = glm::vec2(0.06f * float(view.extent.y) + 18);
            if (is_near_wall || is_near_change || glm::any(glm::lessThan(pixel, border)) ||
                glm::any(glm::greaterThan(pixel, glm::vec2(view.extent) - border)))
                continue;
            const float expected = met.y > 1 ? 1.0f : 0.25f;
            EXPECT_NEAR(frame.radiance.pixel(x, y)[0], expected, 1e-4f * expected) << x << ", " << y;
            ++(met.y > 1 ? above : below);
        }
    EXPECT_GT(below, 1000u);
    EXPECT_GT(above, 1000u);
}

// Energy.

/// All that is seen radiates 1.
SyntheticHit furnace_floor(const CameraRay& ray) {
    SyntheticHit hit = glossy_floor(ray);
    hit.lit = glm::vec3(1);
    return hit;
}

/// With everything radiating 1, each average and each blend of radiance is 1, up to rounding. The original's own losses
/// are switched off: black orphans, and averages of 0 beside tiles without a glossy pixel.
TEST_F(AmdSssrTechnique, KeepsAFurnaceAtOne) {
    const nlohmann::json no_losses = {{"trace_orphans", true}, {"fresh_neighborhood", true}};
    for (const std::string preset : {"corrected", "sdk_1_5"})
        for (const unsigned frames : {1u, 12u}) {
            SCOPED_TRACE(testing::Message() << preset << ", " << frames << " frames");
            const Frame frame = render(preset == "corrected" ? nlohmann::json::object() : no_losses, preset,
                                       furnace_floor, frames, 1.0f);
            const float lost = preset == "corrected" ? 1e-5f : 0x1p-10f;  // halves may be truncated
            float low = 1e9f, high = 0;
            for (size_t i = 0; i < frame.radiance.pixel_count(); ++i)
                if (frame.confidence.values[i] > 0) {
                    low = std::min(low, frame.radiance.values[4 * i]);
                    high = std::max(high, frame.radiance.values[4 * i]);
                }
            EXPECT_GT(low, 1 - lost);
            EXPECT_LT(high, 1 + 1e-5f);
        }
}

// Work that no pixel needs.

SyntheticHit rough_floor(const CameraRay& ray) {
    SyntheticHit hit = glossy_floor(ray);
    hit.roughness = 0.6f;
    return hit;
}

TEST_F(AmdSssrTechnique, LeavesEverythingOutWhereNothingIsGlossy) {
    SceneFacts facts{.has_geometry = true,
                     .has_reflective = true,
                     .min_roughness = 0.6f,
                     .max_roughness = 0.6f,
                     .camera_moves = true,
                     .has_environment = true};
    const auto whole = make_technique("amd_sssr"), less = make_technique("amd_sssr");
    const std::vector<LeftOut> left_out = less->leave_out(facts);
    const Frame all = render(*whole, rough_floor, 2, 0.5f);
    std::vector<std::string> stages;
    for (const PassTime& time : times)
        if (time.stage != "clear") stages.push_back(time.stage);
    const Frame some = render(*less, rough_floor, 2, 0.5f);
    EXPECT_EQ(times.size(), 1u);
    EXPECT_EQ(times.front().stage, "clear");
    ASSERT_EQ(left_out.size(), stages.size());
    for (size_t i = 0; i < stages.size(); ++i) EXPECT_EQ(left_out[i].what, stages[i]);
    // With confidence 0 the composite is the fallback, whatever the radiance.
    EXPECT_EQ(all.confidence.values, HostImage(extent, 1).values);
    EXPECT_EQ(some.confidence.values, all.confidence.values);

    facts.min_roughness = 0.44f;  // alpha 0.194
    EXPECT_TRUE(make_technique("amd_sssr")->leave_out(facts).empty());

    // What 8 bits make of alpha, 0.2 of both, decides with rate_stored_roughness.
    const auto is_left_out = [&](float alpha, float threshold, bool is_rated_as_stored) {
        facts.min_roughness = std::sqrt(alpha);
        return !make_technique("amd_sssr", {{"roughness_threshold_alpha", threshold},
                                            {"rate_stored_roughness", is_rated_as_stored}})
                    ->leave_out(facts)
                    .empty();
    };
    EXPECT_FALSE(is_left_out(0.199f, 0.1999f, false));
    EXPECT_TRUE(is_left_out(0.199f, 0.1999f, true));
    EXPECT_TRUE(is_left_out(0.2015f, 0.2005f, false));
    EXPECT_FALSE(is_left_out(0.2015f, 0.2005f, true));
}

/// The first frame's noise, and with it its rays, are a function of seed and frame alone.
TEST_F(AmdSssrTechnique, RepeatsItselfUnlessTheSeedDiffers) {
    const nlohmann::json parameters = {{"hierarchy.min_traversal_occupancy", 0}, {"denoise", false}};
    const Frame first = render(parameters, "", glossy_floor), again = render(parameters, "", glossy_floor);
    EXPECT_TRUE(first.radiance.values == again.radiance.values);
    view.seed = 1;
    EXPECT_FALSE(first.radiance.values == render(parameters, "", glossy_floor).radiance.values);
}

}  // namespace
