// The simple techniques: which rays they draw and how their mean is taken, against quadrature of the lobe; each switch
// alone.
#include "tests/variants/lobe_quadrature.h"
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/rough_floor.h"
#include "tests/variants/technique_fixture.h"

#include <cstring>

namespace {

struct SimpleSsrTest : TechniqueTest {
    static constexpr glm::uvec2 extent{64, 48};
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};

    /// Channels: radiance, confidence. Frame `frame` of a camera at rest.
    HostImage render(const nlohmann::json& parameters, const SyntheticScene& scene, const std::string& preset = "") {
        const auto technique = make_technique("simple_ssr", parameters, preset);
        PassList pass_list(device(), extent);
        return render(pass_list, *technique, scene, 0);
    }
    HostImage render(PassList& pass_list, Technique& technique, const SyntheticScene& scene, unsigned frame,
                     glm::vec2 motion = glm::vec2(0)) {
        FrameView view{.extent = extent, .frame = frame};
        const CameraData camera = camera_data(pose, frame > 0 ? &pose : nullptr, view);
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        HostImage motions(extent, 2);
        for (size_t i = 0; i < motions.values.size(); ++i) motions.values[i] = motion[int(i % 2)];
        pass_list.upload(gbuffer.motion, motions);
        pass_list.begin_frame(camera, technique.params, gbuffer.images());
        return pass_list.download(technique.render(pass_list, gbuffer).radiance);
    }
};

TEST_F(SimpleSsrTest, MirrorRaysAreThoseOfThePlainestTechnique) {
    const auto plain = make_technique("mcguire_dda");
    PassList pass_list(device(), extent);
    const CameraData camera = camera_data(pose, nullptr, {.extent = extent});
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, mirror_floor);
    pass_list.begin_frame(camera, plain->params, gbuffer.images());
    const Reflections reflections = plain->render(pass_list, gbuffer);
    const HostImage radiance = pass_list.download(reflections.radiance),
                    confidence = pass_list.download(reflections.confidence);
    const HostImage simple = render({{"tracer", "dda"}}, mirror_floor);
    size_t hits = 0;
    for (size_t i = 0; i < simple.pixel_count(); ++i) {
        ASSERT_EQ(simple.rgb(i), radiance.rgb(i));
        ASSERT_EQ(simple.values[4 * i + 3], confidence.values[i]);
        hits += confidence.values[i] > 0;
    }
    EXPECT_GT(hits, 400u);
}

TEST_F(SimpleSsrTest, EveryDrawHasTheMeanOfTheLobeIfWeighed) {
    const RoughFloor floor{.roughness = 0.7f, .pose = pose, .extent = extent};
    const RoughFloor::Mean expected = floor.of_lobe();
    for (const char* draw : {"jittered_ray", "normals", "visible_normals", "cosine"}) {
        SCOPED_TRACE(draw);
        const auto mean_of = [&](const char* weights) {
            const auto technique = make_technique(
                "simple_ssr", changed(RoughFloor::march(),
                                      {{"draw", draw}, {"rays", 16}, {"weights", weights}, {"max_roughness", 1}}));
            PassList pass_list(device(), extent);
            return floor.mean([&](unsigned frame) { return render(pass_list, *technique, floor.scene(), frame); }, 40);
        };
        const RoughFloor::Mean weighed = mean_of("ratio"), alike = mean_of("none");
        // Five standard errors: one false alarm in a million. A ratio of 16 rays is biased by about a sixteenth of the
        // covariance of its sums over their means, at most 2 % here; cells of quadrature and edges of pixels: 1 %.
        EXPECT_NEAR(weighed.shown, expected.shown, 5 * weighed.error + 0.03 * expected.shown);
        EXPECT_NEAR(weighed.confidence, expected.confidence, 5 * weighed.confidence_error + 0.03);
        if (std::string(draw) == "cosine") {
            EXPECT_GT(std::abs(alike.shown - expected.shown), 0.1 * expected.shown);
        }
        if (std::string(draw) == "visible_normals") {
            EXPECT_EQ(alike.shown, weighed.shown);
        }
    }
}

/// Lobes of 0.0001 sr: all lie about the mirror direction, whatever they are called.
TEST_F(SimpleSsrTest, RaysOfSmoothSurfacesAreMirrored) {
    const RoughFloor floor{.roughness = 0.03f, .pose = pose, .extent = extent};
    const HostImage mirror = render(RoughFloor::march(), floor.scene());
    for (const char* draw : {"jittered_ray", "normals", "visible_normals"}) {
        const HostImage drawn =
            render(changed(RoughFloor::march(), {{"draw", draw}, {"weights", "none"}}), floor.scene());
        size_t same = 0, pixels = 0;
        for (size_t i = 0; i < mirror.pixel_count(); ++i) {
            if (mirror.values[4 * i + 3] == 0) continue;
            ++pixels, same += drawn.rgb(i) == mirror.rgb(i);
        }
        EXPECT_GT(double(same), 0.95 * double(pixels)) << draw << ": but for edges";
    }
}

TEST_F(SimpleSsrTest, TheRuleOf45DegreesLeavesOutSteepViews) {
    pose.vertical_fov = 2.4f;  // so that steep rays find the wall, too
    const HostImage all = render({}, mirror_floor), some = render({{"rule_of_45_degrees", true}}, mirror_floor);
    size_t kept = 0, left_out = 0;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f);
            const bool is_steep = -ray.direction.y > std::sqrt(0.5f);
            const float expected = is_steep ? 0.0f : all.pixel(x, y)[3];
            if (std::abs(-ray.direction.y - std::sqrt(0.5f)) < 1e-5f) continue;
            ASSERT_EQ(some.pixel(x, y)[3], expected) << x << ", " << y;
            kept += expected > 0, left_out += all.pixel(x, y)[3] > expected;
        }
    EXPECT_GT(kept, 50u);
    EXPECT_GT(left_out, 50u);
}

/// A board in the air, 3 m away, above a mirror floor that ends 6 m away, below nothing.
SyntheticHit floor_and_board(const CameraRay& ray) {
    const float to_board = -3.0f / ray.direction.z;
    const glm::vec3 at = ray.origin + to_board * ray.direction;
    if (std::abs(at.x) < 0.5f && at.y > -0.1f && at.y < 0.5f)
        return {.distance = to_board, .normal = {0, 0, 1}, .lit = glm::vec3(1)};
    return floor_below_nothing(ray);
}

/// Against the same steps with depths by formula: a ray that passes metres behind the board is said to meet it.
TEST_F(SimpleSsrTest, ThePrintedMirrorMeetsWhateverIsSeenBeforeItsRay) {
    const HostImage printed = render({}, floor_and_board, "slides_mirror_printed"),
                    thin = render({}, floor_and_board, "slides_mirror");
    const CameraData camera = camera_data(pose, nullptr, {.extent = extent});
    struct Seen {
        bool is_board, is_mirror;
        glm::vec3 position;
    };
    std::vector<Seen> seen;
    for (unsigned i = 0; i < extent.x * extent.y; ++i) {
        const CameraRay ray = camera_ray(pose, extent, glm::vec2(i % extent.x, i / extent.x) + 0.5f);
        const SyntheticHit hit = floor_and_board(ray);
        seen.push_back({std::isfinite(hit.distance) && hit.metalness == 0, hit.metalness > 0,
                        ray.origin + hit.distance * ray.direction});
    }
    const auto meets_board = [&](glm::vec3 origin, glm::vec3 direction) {
        for (int i = 1; i <= 512; ++i) {
            const float distance = 40.0f * float(i) / 512;
            const glm::vec3 point = origin + distance * direction;
            const glm::vec4 clip = camera.clip_from_view * glm::vec4(point, 1);
            const glm::vec2 ndc = glm::vec2(clip) / clip.w;
            if (std::abs(ndc.x) >= 1 || std::abs(ndc.y) >= 1) return false;
            const glm::uvec2 pixel((0.5f + 0.5f * ndc) * glm::vec2(extent));
            const auto& [is_board, is_mirror, position] = seen[pixel.y * extent.x + pixel.x];
            const bool is_own_plane = position.y - origin.y < 0.5f * direction.y * distance;
            if (is_board && !is_own_plane && position.z > point.z) return true;
        }
        return false;
    };
    size_t hits = 0, far_behind = 0;
    for (size_t i = 0; i < seen.size(); ++i) {
        if (!seen[i].is_mirror) continue;
        const glm::vec3 origin = seen[i].position;
        const bool is_met = meets_board(origin, glm::reflect(glm::normalize(origin), glm::vec3(0, 1, 0)));
        ASSERT_EQ(printed.values[4 * i + 3], is_met ? 1.0f : 0.0f) << i % extent.x << ", " << i / extent.x;
        hits += is_met;
        if (origin.z > -4) continue;
        far_behind += is_met;
        ASSERT_EQ(thin.values[4 * i + 3], 0) << i % extent.x << ", " << i / extent.x;
    }
    EXPECT_GT(hits, 100u);
    EXPECT_GT(far_behind, 20u);
}

TEST_F(SimpleSsrTest, PreviousFrameShowsWhereItsSurfaceWas) {
    const auto with_light = [](float radiance) {
        return [=](const CameraRay& ray) {
            SyntheticHit hit = floor_before_white(ray);
            hit.lit *= radiance;
            return hit;
        };
    };
    const auto technique = make_technique("simple_ssr", {{"previous_frame", true}});
    PassList pass_list(device(), extent);
    const HostImage first = render(pass_list, *technique, with_light(1), 0),
                    second = render(pass_list, *technique, with_light(3), 1);
    size_t hits = 0;
    for (size_t i = 0; i < first.pixel_count(); ++i) {
        ASSERT_EQ(first.values[4 * i + 3], second.values[4 * i + 3]);
        if (first.values[4 * i + 3] == 0) continue;
        ++hits;
        ASSERT_EQ(first.rgb(i), glm::vec3(1)) << "there is no frame before the first";
        ASSERT_EQ(second.rgb(i), glm::vec3(1)) << "the light of the frame before";
    }
    EXPECT_GT(hits, 400u);
    // All has come from 1.5 screens above: hits show the clamped border of the frame before, its uppermost row.
    const HostImage moved = render(pass_list, *technique, with_light(3), 2, {0, 1.5f});
    for (size_t i = 0; i < moved.pixel_count(); ++i)
        if (moved.values[4 * i + 3] > 0) {
            ASSERT_EQ(moved.rgb(i), glm::vec3(3));
        }
    const HostImage from_floor = render(pass_list, *technique, with_light(3), 3, {0, -1.5f});
    for (size_t i = 0; i < moved.pixel_count(); ++i)
        if (from_floor.values[4 * i + 3] > 0) {
            ASSERT_EQ(from_floor.rgb(i), glm::vec3(0)) << "the floor is black";
        }
}

TEST_F(SimpleSsrTest, BlurIsTheMeanOverASquareOfPixelsThatReflect) {
    const RoughFloor floor{.roughness = 0.5f, .pose = pose, .extent = extent};
    const HostImage sharp = render({}, floor.scene()), blurred = render({{"blur_width", 0.1}}, floor.scene());
    const int reach = int(std::lround(0.1f * float(extent.y) * 0.5f));
    size_t compared = 0;
    for (int y = 0; y < int(extent.y); ++y)
        for (int x = 0; x < int(extent.x); ++x) {
            if (!floor.is_floor(unsigned(x), unsigned(y))) {
                ASSERT_EQ(blurred.pixel(unsigned(x), unsigned(y))[3], 0);
                continue;
            }
            glm::dvec4 sum(0);
            double count = 0;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, int(extent.y) - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, int(extent.x) - 1); ++u) {
                    if (!floor.is_floor(unsigned(u), unsigned(v))) continue;
                    const float* p = sharp.pixel(unsigned(u), unsigned(v));
                    sum += double(p[3]) * glm::dvec4(p[0], p[1], p[2], 1);
                    ++count;
                }
            const float* p = blurred.pixel(unsigned(x), unsigned(y));
            ASSERT_NEAR(p[3], sum.w / count, 1e-5) << x << ", " << y;  // float sums of up to 15 terms each way
            if (sum.w > 0) {
                ASSERT_NEAR(p[0], sum.x / sum.w, 1e-5 * std::max(1.0, sum.x / sum.w));
            }
            compared += p[0] > 0.3f && p[0] < 0.95f;
        }
    EXPECT_GT(compared, 50u);
}

TEST_F(SimpleSsrTest, MirrorsStaySharpBesideABlur) {
    const HostImage sharp = render({}, mirror_floor), blurred = render({{"blur_width", 0.2}}, mirror_floor);
    EXPECT_EQ(sharp.values, blurred.values);
}

TEST_F(SimpleSsrTest, LeavesOutAllWhereNothingReflects) {
    const auto technique = make_technique("simple_ssr", {}, "slides_blurred");
    SceneFacts facts{};
    facts.has_reflective = true, facts.min_roughness = 0.9f;
    EXPECT_EQ(technique->leave_out(facts).size(), 4u);
    PassList pass_list(device(), extent);
    const HostImage result = render(pass_list, *technique, floor_before_white, 0);
    EXPECT_TRUE(std::ranges::all_of(result.values, [](float v) { return v == 0; }));
}

}  // namespace
