// The four-mode pass: its printed numbers, its fades, its mixture of draws, its blend over time.
#include "tests/variants/changed.h"
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/rough_floor.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace {

using Parameters = nlohmann::json;

struct FourModeTest : TechniqueTest {
    static constexpr glm::uvec2 extent{64, 48};
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    DepthDirection depth = DepthDirection::standard;
    PassList pass_list{device(), extent};

    /// Channels: radiance, confidence. `before`: the camera of the frame before, if there is one.
    /// `motion`: of the pixels that `moves`, in place of the scene's.
    HostImage render(
        Technique& technique, const SyntheticScene& scene, unsigned frame = 0, const CameraPose* before = nullptr,
        std::optional<glm::vec2> motion = {},
        const std::function<bool(const SyntheticHit&)>& moves = [](const SyntheticHit&) { return true; }) {
        const FrameView view{.extent = extent, .depth_direction = depth, .frame = frame};
        const CameraData camera = camera_data(pose, before, view);
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        HostImage motions = motion_of(pose, camera, scene);
        for (size_t i = 0; motion && i < motions.values.size(); ++i) {
            const glm::vec2 place = glm::vec2(i / 2 % extent.x, i / 2 / extent.x) + 0.5f;
            if (moves(scene(camera_ray(pose, extent, place)))) motions.values[i] = (*motion)[int(i % 2)];
        }
        pass_list.upload(gbuffer.motion, motions);
        pass_list.begin_frame(camera, technique.params, gbuffer.images());
        return pass_list.download(technique.render(pass_list, gbuffer).radiance);
    }
    HostImage render(const Parameters& parameters, const SyntheticScene& scene, const std::string& preset = "") {
        return render(*make_technique("four_mode_ssr", parameters, preset), scene);
    }
};

/// Fades that depend on the ray off.
Parameters without_fades(Parameters parameters = Parameters::object()) {
    for (const std::string march : {"fixed_stride", "cells"})
        parameters.update({{march + ".edge_fade", false}, {march + ".distance_fade", false}});
    parameters.update({{"cells.back_faces", "keep"}, {"cells.grazing_fade", 0}});
    return parameters;
}

/// A wall of the given radiance, above a mirror of some roughness.
SyntheticScene floor_and_wall(float radiance, float roughness = 0) {
    return [=](const CameraRay& ray) {
        SyntheticHit hit = floor_before_white(ray);
        hit.lit *= radiance;
        if (hit.metalness > 0) hit.roughness = roughness;
        return hit;
    };
}

/// A wall of one radiance on the left and another on the right, above a mirror.
SyntheticScene striped(float left, float right) {
    return [=](const CameraRay& ray) {
        SyntheticHit hit = floor_before_white(ray);
        hit.lit *= ray.direction.x < 0 ? left : right;
        return hit;
    };
}

/// Mode temporal with one mirror ray for each pixel, so that only the history decides what is blended.
std::unique_ptr<Technique> temporal(const Parameters& others) {
    const Parameters mirror = {{"mode", "temporal"}, {"num_rays", 1}, {"brdf_bias", 1}};
    return make_technique("four_mode_ssr", without_fades(changed(mirror, others)), "corrected");
}

}  // namespace

TEST_F(FourModeTest, PresetsAreThoseOfThePrintedTable) {
    struct Row {
        const char* preset;
        int max_steps, binary_search_steps;
        double stride;
        int num_rays;
    };
    for (const Row& row : {Row{"low", 32, 4, 2.0, 1},
                           {"medium", 48, 6, 1.5, 2},
                           {"high", 64, 8, 1.0, 4},
                           {"ultra", 96, 12, 0.5, 8},
                           {"custom", 64, 8, 1.0, 4}}) {
        const nlohmann::json values = make_technique("four_mode_ssr", {}, row.preset)->params.values();
        EXPECT_EQ(values["cells.max_steps"], row.max_steps) << row.preset;
        EXPECT_EQ(values["fixed_stride.max_steps"], row.max_steps) << row.preset;
        EXPECT_EQ(values["fixed_stride.binary_search_steps"], row.binary_search_steps) << row.preset;
        EXPECT_EQ(values["fixed_stride.stride"], row.stride) << row.preset;
        EXPECT_EQ(values["num_rays"], row.num_rays) << row.preset;
    }
    // "SSSRSettings Structure".
    const nlohmann::json settings = make_technique("four_mode_ssr", {})->params.values();
    const Parameters printed = {

        {"roughness_fade", 0.5},
        {"intensity", 1.0},
        {"num_rays", 4},
        {"brdf_bias", 0.5},
        {"temporal_blend", 0.9},
        {"motion_threshold", 0.01},
        {"fixed_stride.jitter", 0.0},
        {"fixed_stride.stride_z_cutoff", 100.0},
        {"fixed_stride.thickness", 0.5},
        {"cells.thickness", 0.5},
        {"fixed_stride.max_distance", 50.0},
        {"cells.max_distance", 50.0},
        {"cells.fade_start", 0.8},
        {"cells.fade_end", 1.0},
        {"fixed_stride.fade_start", 0.8},
        {"fixed_stride.fade_end", 1.0},
        {"cells.safe_steps", 3}};
    for (const auto& [name, value] : printed.items())
        EXPECT_NEAR(settings[name].is_string() ? 0.0 : settings[name].get<double>() - value.get<double>(), 0.0, 1e-6)
            << name;
    EXPECT_EQ(settings["mode"], "hiz");
    EXPECT_EQ(settings["noise"], "blue");
    EXPECT_EQ(settings["fixed_stride.refine"], false) << "the printed march takes no step back";
    EXPECT_NEAR(settings["sky_depth"].get<double>(), 1e-4, 1e-10);
}

/// A mirror that leans back, from some 65 m to 99 m, below a ceiling: what lies beyond 91 m differs by less than 1e-4
/// from the far plane.
TEST_F(FourModeTest, PixelsNearTheFarPlaneStartNoRayAsPrinted) {
    const SyntheticScene scene = [](const CameraRay& ray) -> SyntheticHit {
        const glm::vec3 n = glm::normalize(glm::vec3(0, 20, 30));
        if (ray.direction.y < 0)
            return {.distance = glm::dot(n, glm::vec3(0, 0, -99)) / glm::dot(n, ray.direction),
                    .normal = n,
                    .roughness = 0,
                    .metalness = 1,
                    .specular = 1};
        return {.distance = std::min(10 / ray.direction.y, -99 / ray.direction.z),
                .normal = {0, -1, 0},
                .lit = glm::vec3(1)};
    };
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed})
        for (const char* mode : {"simple_linear", "hiz"}) {
            depth = direction;
            const Parameters parameters = {{"mode", mode}};
            const HostImage all = render(parameters, scene, "corrected");
            const HostImage near = render(changed(parameters, {{"sky_depth", 1e-4}}), scene, "corrected");
            size_t kept = 0, left_out = 0;
            for (unsigned y = 0; y < extent.y; ++y)
                for (unsigned x = 0; x < extent.x; ++x) {
                    const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f);
                    const float distance = -scene(ray).distance * ray.direction.z;
                    const float from_far_plane = (1 / distance - 0.01f) / (10 - 0.01f);
                    if (std::abs(from_far_plane - 1e-4f) < 1e-6f) continue;
                    const bool is_near = from_far_plane > 1e-4f;
                    ASSERT_EQ(near.pixel(x, y)[3], is_near ? all.pixel(x, y)[3] : 0.0f) << x << ", " << y;
                    if (all.pixel(x, y)[3] > 0) ++(is_near ? kept : left_out);
                }
            EXPECT_GT(kept, 15u) << mode;
            EXPECT_GT(left_out, 15u) << mode;
        }
}

TEST_F(FourModeTest, BlueNoiseHasTheMeanOfWhiteNoiseAndComesCloserToItInTenFrames) {
    const RoughFloor floor{.roughness = 0.35f, .pose = pose, .extent = extent};
    const unsigned frames = 10, groups = 12;
    double mean[2] = {}, variance[2] = {};  // of a pixel's mean over `frames` frames
    for (const int is_blue : {0, 1}) {
        const auto technique = make_technique(
            "four_mode_ssr",
            changed(RoughFloor::march(),
                    {{"mode", "stochastic"}, {"noise", is_blue ? "blue" : "white"}, {"roughness_fade", 1}}));
        std::vector<double> sums(floor.columns().size() * groups);
        for (unsigned frame = 0; frame < frames * groups; ++frame) {
            const HostImage image = render(*technique, floor.scene(), frame);
            for (size_t i = 0; i < floor.columns().size(); ++i) {
                const float* p = image.pixel(floor.columns()[i], floor.row());
                sums[i * groups + frame / frames] += double(p[0]) * p[3] / frames;
            }
        }
        for (size_t i = 0; i < floor.columns().size(); ++i) {
            double of_pixel = 0;
            for (unsigned g = 0; g < groups; ++g) of_pixel += sums[i * groups + g] / groups;
            for (unsigned g = 0; g < groups; ++g)
                variance[is_blue] += std::pow(sums[i * groups + g] - of_pixel, 2) / (groups - 1);
            mean[is_blue] += of_pixel / double(floor.columns().size());
        }
        variance[is_blue] /= double(floor.columns().size());
    }
    // Five standard errors of the white mean, which is the noisier one. Variances of 99 degrees of freedom have a
    // standard error of 14 %.
    EXPECT_NEAR(mean[1], mean[0], 5 * std::sqrt(variance[0] / double(groups * floor.columns().size())));
    EXPECT_LT(variance[1], 0.5 * variance[0]);
}

TEST_F(FourModeTest, BothMirrorModesFindTheWall) {
    for (const char* mode : {"simple_linear", "hiz"})
        for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
            SCOPED_TRACE(std::string(mode) + (direction == DepthDirection::reversed ? ", reversed" : ""));
            depth = direction;
            const HostImage image = render({{"mode", mode}}, floor_and_wall(2), "corrected");
            size_t hits = 0, possible = 0;
            for (unsigned y = 0; y < extent.y; ++y)
                for (unsigned x = 0; x < extent.x; ++x) {
                    const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f);
                    const SyntheticHit first = mirror_floor(ray);
                    const float* p = image.pixel(x, y);
                    if (first.metalness == 0) {
                        ASSERT_EQ(p[3], 0);
                        continue;
                    }
                    const glm::vec3 from = first.distance * ray.direction, d = ray.direction * glm::vec3(1, -1, 1);
                    const glm::vec3 hit = from + (-6 - from.z) / d.z * d;
                    const float limit = std::tan(0.5f * pose.vertical_fov) * 6;
                    const bool is_seen = std::abs(hit.y) < 0.95f * limit && std::abs(hit.x) < 0.95f * limit * 4 / 3;
                    possible += is_seen;
                    hits += is_seen && p[3] == 1 && p[0] == 2;
                    if (std::abs(hit.y) > 1.05f * limit) {
                        ASSERT_EQ(p[3], 0) << x << ", " << y;
                    }
                }
            EXPECT_GT(possible, 400u);
            EXPECT_GT(double(hits), 0.99 * double(possible)) << "but for pixels at the foot of the wall";
        }
}

TEST_F(FourModeTest, RoughnessAndIntensityFadeTheConfidence) {
    for (const char* mode : {"simple_linear", "hiz"})
        for (const float roughness : {0.0f, 0.1f, 0.25f, 0.45f}) {
            const HostImage image =
                render(without_fades({{"mode", mode}, {"intensity", 0.7}}), floor_and_wall(1, roughness), "corrected");
            size_t hits = 0;
            for (size_t i = 0; i < image.pixel_count(); ++i) {
                const float confidence = image.values[4 * i + 3];
                if (confidence == 0) continue;
                ++hits;
                ASSERT_NEAR(confidence, 0.7f * (1 - roughness / 0.5f), 1e-3f);  // half floats
            }
            EXPECT_GT(hits, 300u);
        }
    const HostImage rough = render(without_fades(), floor_and_wall(1, 0.5f));
    EXPECT_TRUE(std::ranges::all_of(rough.values, [](float v) { return v == 0; }));
}

TEST_F(FourModeTest, AnyMixtureHasTheMeanOfTheLobeIfWeighed) {
    const RoughFloor floor{.roughness = 0.35f, .pose = pose, .extent = extent};
    const double fade = 1 - 0.35;  // with roughness_fade 1
    const double of_lobe = floor.of_lobe().shown;
    for (const double bias : {0.0, 0.1, 1.0})
        for (const char* weights : {"ratio", "none"}) {
            SCOPED_TRACE(std::to_string(bias) + weights);
            const auto technique =
                make_technique("four_mode_ssr", changed(RoughFloor::march(), {{"mode", "stochastic"},
                                                                              {"num_rays", 8},
                                                                              {"brdf_bias", bias},
                                                                              {"weights", weights},
                                                                              {"noise", "white"},
                                                                              {"roughness_fade", 1}}));
            const bool is_weighed = std::string(weights) == "ratio";
            const RoughFloor::Mean mean = floor.mean(
                [&](unsigned frame) { return render(*technique, floor.scene(), frame); }, is_weighed ? 250 : 40);
            if (is_weighed) {
                const RoughFloor::Mean expected = floor.of_mixture(bias, 8, 10000);
                // Five standard errors, one false alarm in a million; edges of pixels: 1 %.
                EXPECT_NEAR(mean.shown / fade, expected.shown,
                            5 * std::hypot(mean.error / fade, expected.error) + 0.01 * expected.shown);
                // Few rays are biased, by a sixth for uniform ones; many are not.
                const RoughFloor::Mean of_many = floor.of_mixture(bias, 1000, 40);
                EXPECT_NEAR(of_many.shown, of_lobe, 5 * of_many.error + 0.01 * of_lobe);
            } else if (bias < 1) {
                EXPECT_GT(std::abs(mean.shown / fade - of_lobe), 0.1 * of_lobe) << "uniform rays taken for the lobe's";
            }
        }
}

TEST_F(FourModeTest, MotionVectorsSayWhereTheHistoryIs) {
    // 4 of 64 pixels to the right: 0.0625 of the threshold of 0.1 leave 0.375 of the blend.
    const auto technique =
        temporal({{"neighborhood_clamp", false}, {"reject_other_surfaces", false}, {"motion_threshold", 0.1}});
    const HostImage first = render(*technique, striped(1, 2), 0);
    const HostImage second = render(*technique, striped(0, 0), 1, &pose, glm::vec2(4.0f / extent.x, 0));
    size_t compared = 0, changed_side = 0;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 4; x < extent.x; ++x) {
            const float* before = first.pixel(x - 4, y);
            if (before[3] != 1 || second.pixel(x, y)[3] < 0.9995f) continue;
            ASSERT_NEAR(second.pixel(x, y)[0], 0.9f * 0.375f * before[0], 2e-3f) << x << ", " << y;  // half floats
            ++compared, changed_side += before[0] != first.pixel(x, y)[0];
        }
    EXPECT_GT(compared, 400u);
    EXPECT_GT(changed_side, 20u);
}

TEST_F(FourModeTest, HistoryOfAReflectionMovesWithWhatIsReflected) {
    // A wall moves by 4 of 64 pixels to the right above a floor that stands still: so does its image, by 0.0625 of the
    // threshold of 0.1.
    const auto technique = temporal({{"history_place", "reflection"},
                                     {"neighborhood_clamp", false},
                                     {"reject_other_surfaces", false},
                                     {"motion_threshold", 0.1}});
    const auto moves = [](const SyntheticHit& hit) { return hit.metalness == 0; };
    const HostImage first = render(*technique, striped(1, 2), 0);
    const HostImage second = render(*technique, striped(1, 1), 1, &pose, glm::vec2(4.0f / extent.x, 0), moves);
    size_t compared = 0, changed_side = 0;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 4; x < extent.x; ++x) {
            const float* before = first.pixel(x - 4, y);
            if (before[3] != 1 || second.pixel(x, y)[3] < 0.9995f) continue;
            // Not at the edge of both lights: the tail of the narrowest lobe moves images by up to 0.08 pixel more.
            if (x < 5 || before[0] != first.pixel(x - 5, y)[0] || before[0] != first.pixel(x - 3, y)[0]) continue;
            const float of_history = 0.9f * 0.375f;
            // Half floats above 1, twice as coarse as those below, which others here compare by 2e-3.
            ASSERT_NEAR(second.pixel(x, y)[0], 1 - of_history + of_history * before[0], 4e-3f) << x << ", " << y;
            ++compared, changed_side += before[0] != first.pixel(x, y)[0];
        }
    EXPECT_GT(compared, 400u);
    EXPECT_GT(changed_side, 20u);
}

TEST_F(FourModeTest, HistoryFadesAsTheBlendSays) {
    // The light goes out after the first frame; without the clamp what is left of it is 0.9^n.
    const auto technique = temporal({{"neighborhood_clamp", false}});
    const HostImage lit = render(*technique, floor_and_wall(1), 0);
    float expected = 1;
    for (unsigned frame = 1; frame < 6; ++frame) {
        const HostImage dark = render(*technique, floor_and_wall(0), frame, &pose);
        expected *= 0.9f;
        size_t compared = 0;
        for (size_t i = 0; i < dark.pixel_count(); ++i) {
            if (lit.values[4 * i + 3] != 1 || dark.values[4 * i + 3] < 0.9995f) continue;
            ++compared;
            ASSERT_NEAR(dark.values[4 * i], expected, 2e-3f);  // half floats, blended five times
        }
        EXPECT_GT(compared, 400u);
    }
}

TEST_F(FourModeTest, TheClampEndsWhatNoNeighbourShows) {
    const auto technique = temporal(Parameters::object());
    render(*technique, floor_and_wall(1), 0);
    const HostImage dark = render(*technique, floor_and_wall(0), 1, &pose);
    for (size_t i = 0; i < dark.pixel_count(); ++i) ASSERT_EQ(dark.rgb(i), glm::vec3(0));
}

TEST_F(FourModeTest, MotionRejectsTheHistoryInProportion) {
    // A camera that turns about its axis of view: a pixel's motion is its distance from the middle times the angle.
    const float turn = 0.02f;
    for (const char* history_place : {"camera", "motion_vectors"}) {
        const auto technique = temporal({{"neighborhood_clamp", false},
                                         {"reject_other_surfaces", false},
                                         {"motion_threshold", 0.01},
                                         {"history_place", history_place}});
        const CameraPose before = pose;
        const HostImage lit = render(*technique, floor_and_wall(1), 0);
        CameraPose turned = pose;
        turned.world_from_view = glm::rotate(glm::mat4(1), turn, glm::vec3(0, 0, 1));
        std::swap(pose, turned);
        const HostImage dark = render(*technique, floor_and_wall(0), 1, &before);
        size_t kept = 0, rejected = 0;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const glm::vec2 place = glm::vec2(x, y) + 0.5f, centre = 0.5f * glm::vec2(extent);
                const glm::vec2 from = place - centre;
                const glm::vec2 back(std::cos(turn) * from.x + std::sin(turn) * from.y,
                                     -std::sin(turn) * from.x + std::cos(turn) * from.y);
                const glm::vec2 back_other(std::cos(turn) * from.x - std::sin(turn) * from.y,
                                           std::sin(turn) * from.x + std::cos(turn) * from.y);
                const float motion = glm::length((back - from) / glm::vec2(extent));
                ASSERT_NEAR(motion, glm::length((back_other - from) / glm::vec2(extent)), 0.03f * motion + 1e-6f);
                const float* p = dark.pixel(x, y);
                // Only where both frames show a hit all around.
                bool is_inside = p[3] > 0.9995f;
                for (int i = 0; is_inside && i < 49; ++i) {
                    const glm::ivec2 n = glm::ivec2(x, y) + glm::ivec2(i % 7, i / 7) - 3;
                    is_inside = n.x >= 0 && n.y >= 0 && n.x < int(extent.x) && n.y < int(extent.y) &&
                                lit.pixel(unsigned(n.x), unsigned(n.y))[3] == 1;
                }
                if (!is_inside) continue;
                const float expected = 0.9f * std::clamp(1 - motion / 0.01f, 0.0f, 1.0f);
                ASSERT_NEAR(p[0], expected, 5e-3f) << history_place << " " << x << ", " << y;
                (expected > 0 ? kept : rejected) += 1;
            }
        EXPECT_GT(kept, 40u);
        EXPECT_GT(rejected, 10u);
        std::swap(pose, turned);
    }
}

TEST_F(FourModeTest, LeavesOutAllWhereNothingReflects) {
    for (const char* mode : {"simple_linear", "hiz", "temporal"}) {
        const auto technique = make_technique("four_mode_ssr", {{"mode", mode}});
        SceneFacts facts{};
        facts.has_reflective = true, facts.min_roughness = 0.5f;
        EXPECT_EQ(technique->leave_out(facts).size(), std::string(mode) == "temporal" ? 3u
                                                      : std::string(mode) == "hiz"    ? 2u
                                                                                      : 1u);
        const HostImage result = render(*technique, floor_before_white);
        EXPECT_TRUE(std::ranges::all_of(result.values, [](float v) { return v == 0; }));
    }
}
