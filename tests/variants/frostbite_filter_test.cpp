// Frostbite's temporal filter on its own: what it averages, when it has no history, and how it clamps it.
#include "core/split_sum.h"
#include "tests/variants/frostbite_filter_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace {

// What is averaged.

/// Independent values of mean 1 (colour) and 1/2 (confidence); a third of the pixels sees nothing. After n frames the
/// average is w^n of the first one and (1 - w) w^k of the one k frames ago.
TEST_F(FrostbiteFilterTest, AveragesColorTimesConfidenceExponentially) {
    const double weight = 0.8;
    FrostbiteFilterBench bench(device(), view, {{"history_weight", weight}, {"neighborhood_clamp", false}});
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<glm::dvec4> expected(view.extent.x * view.extent.y);
    HostImage found;
    for (unsigned frame = 0; frame < 8; ++frame)
        found = bench.next(pose, wall_of_mirror, [&](glm::uvec2 pixel, const CameraRay&) {
            const ResolvedPixel drawn{.radiance = 2.0f * glm::vec3(uniform(random), uniform(random), uniform(random)),
                                      .confidence = uniform(random) < 1.0f / 3 ? 0 : uniform(random),
                                      .ray_length = uniform(random) < 0.5f ? 0 : 7 * uniform(random)};
            const glm::dvec4 now(glm::dvec3(drawn.radiance) * double(drawn.confidence), drawn.confidence);
            glm::dvec4& average = expected[pixel.y * view.extent.x + pixel.x];
            average = frame == 0 ? now : glm::mix(now, average, weight);
            return drawn;
        });
    // Projecting a still point and back moves it by up to 1e-4 pixels, by which neighbours up to 2 apart are mixed in.
    for (size_t i = 0; i < expected.size(); ++i) {
        const glm::dvec4 average = weighed(&found.values[4 * i]);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(average[c], expected[i][c], 1e-3) << i;
    }
}

TEST_F(FrostbiteFilterTest, SwitchedOffOrInTheFirstFramePassesThrough) {
    const auto checker = [](glm::uvec2 pixel, const CameraRay&) {
        return ResolvedPixel{.radiance = glm::vec3(float(pixel.x % 3), 1, float(pixel.y)), .ray_length = 2};
    };
    const auto black = [](glm::uvec2, const CameraRay&) { return ResolvedPixel{}; };
    FrostbiteFilterBench on(device(), view, nlohmann::json::object()),
        off(device(), view, {{"temporal_filter", false}});
    off.next(pose, wall_of_mirror, black);
    const HostImage first = on.next(pose, wall_of_mirror, checker), second = off.next(pose, wall_of_mirror, checker);
    EXPECT_EQ(first.values, second.values);
    EXPECT_EQ(*first.pixel(5, 7), 2.0f);
    EXPECT_EQ(first.pixel(5, 7)[2], 7.0f);
}

/// Given times reflectance, as frostbite_resolve() then does, incident radiance comes out; of history, too.
TEST_F(FrostbiteFilterTest, DividesByReflectanceWhereItWasMultipliedBefore) {
    view.extent = {12, 8};
    const auto reflected = [&](glm::uvec2, const CameraRay& ray) {
        const glm::dvec2 ab = split_sum(-ray.direction.z, 0.2 * 0.2);
        return ResolvedPixel{.radiance = glm::vec3(3, 2, 1) * float(ab.x + ab.y), .confidence = 0.5f, .ray_length = 1};
    };
    for (const bool temporal_filter : {false, true}) {
        FrostbiteFilterBench bench(device(), view,
                                   {{"reflectance_after_filter", false}, {"temporal_filter", temporal_filter}});
        bench.next(pose, wall_of_mirror, reflected);
        const HostImage found = bench.next(pose, wall_of_mirror, reflected);
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                // The table of split_sum() has errors up to 1e-3.
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.pixel(x, y)[c], float(3 - c), 3e-3f);
                EXPECT_NEAR(found.pixel(x, y)[3], 0.5f, 1e-5f);
            }
    }
}

// When there is none.

struct FrostbiteLostHistoryTest : FrostbiteFilterTest {
    /// Share of the pixels that `scene` shows that keep a history which `scene_before` left from `before`.
    float kept(const SyntheticScene& scene_before, const CameraPose& before, const SyntheticScene& scene,
               float ray_length = 1) {
        FrostbiteFilterBench bench(device(), view, history_alone);
        bench.next(before, scene_before, [](glm::uvec2, const CameraRay&) {
            return ResolvedPixel{.radiance = glm::vec3(1), .ray_length = 1};
        });
        const HostImage found = bench.next(
            pose, scene, [&](glm::uvec2, const CameraRay&) { return ResolvedPixel{.ray_length = ray_length}; });
        float sum = 0, count = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                if (scene(ray_of(pose, x, y)).metalness == 0) continue;
                sum += *found.pixel(x, y);
                ++count;
            }
        return sum / count;
    }
    float kept(const SyntheticScene& scene_before) { return kept(scene_before, pose, wall_of_mirror); }
};

TEST_F(FrostbiteLostHistoryTest, OfOtherSurfaces) {
    const auto changed = [](const std::function<void(SyntheticHit&)>& change) {
        return [change](const CameraRay& ray) {
            SyntheticHit hit = wall_of_mirror(ray);
            change(hit);
            return hit;
        };
    };
    // What is bilinear weighs 1, up to rounding.
    EXPECT_NEAR(kept(changed([](SyntheticHit&) {})), 1, 1e-6);
    EXPECT_NEAR(kept(changed([](SyntheticHit& hit) { hit.distance *= 0.995f; })), 1, 1e-6);
    EXPECT_EQ(kept(changed([](SyntheticHit& hit) { hit.distance *= 0.98f; })), 0);
    EXPECT_EQ(kept(changed([](SyntheticHit& hit) { hit.distance *= 1.02f; })), 0);
    EXPECT_EQ(kept(changed([](SyntheticHit& hit) { hit.normal = glm::normalize(glm::vec3(0.5f, 0, 1)); })), 0);
    EXPECT_NEAR(kept(changed([](SyntheticHit& hit) { hit.normal = glm::normalize(glm::vec3(0.4f, 0, 1)); })), 1, 1e-6);
    EXPECT_NEAR(kept(changed([](SyntheticHit& hit) { hit.roughness += 0.09f; })), 1, 1e-6);
    EXPECT_EQ(kept(changed([](SyntheticHit& hit) { hit.roughness += 0.11f; })), 0);
    EXPECT_EQ(kept(changed([](SyntheticHit& hit) { hit.metalness = hit.specular = 0; })), 0) << "nothing reflected";
    pose.far = 5.02f;
    EXPECT_EQ(kept(changed([](SyntheticHit& hit) { hit = {}; })), 0) << "the background, as near as the wall";
}

/// Samples beside the pixels' centres are of the same plane, however coarse the pixels.
TEST_F(FrostbiteLostHistoryTest, NotOfASlopeThatIsJittered) {
    const SyntheticScene slope = [](const CameraRay& ray) {
        SyntheticHit hit = wall_of_mirror(ray);
        hit.normal = glm::normalize(glm::vec3(0, 1, 1));
        hit.distance = -5 / glm::dot(ray.direction, hit.normal);
        return hit;
    };
    view.extent = {20, 16};
    view.jitter = view.previous_jitter = {0.4f, 0.4f};
    // Half a row and half a column have left the screen.
    EXPECT_GT(kept(slope, pose, slope), 0.85f);
}

/// What was seen of the post does not bleed into its neighbours, either.
TEST_F(FrostbiteLostHistoryTest, WhereAPostStoodBefore) {
    const auto with_post = [](const CameraRay& ray) {
        const float x = -2 * ray.direction.x / ray.direction.z;
        return std::abs(x) < 0.5f ? SyntheticHit{.distance = -2 / ray.direction.z, .normal = {0, 0, 1}}
                                  : wall_of_mirror(ray);
    };
    double covered = 0;
    for (unsigned x = 0; x < view.extent.x; ++x) covered += with_post(ray_of(pose, x, 0)).metalness == 0;
    EXPECT_NEAR(kept(with_post), 1 - covered / view.extent.x, 1e-6);
}

TEST_F(FrostbiteLostHistoryTest, OutsideThePreviousScreenOrBehindIt) {
    CameraPose before = pose;
    before.world_from_view = glm::translate(glm::mat4(1), glm::vec3(100, 0, 0));
    EXPECT_EQ(kept(wall_of_mirror, before, wall_of_mirror), 0);
    // The mirror image was behind the camera, where its projection is on the screen, upside down, and shows this wall.
    before.world_from_view = glm::rotate(glm::mat4(1), glm::pi<float>(), glm::vec3(0, 1, 0));
    const auto room = [](const CameraRay& ray) {
        SyntheticHit hit = wall_of_mirror(ray);
        hit.distance = std::abs(hit.distance);
        return hit;
    };
    EXPECT_EQ(kept(room, before, wall_of_mirror, 3), 0);
}

/// It fades by the weight of history where it was, or is forgotten at once.
TEST_F(FrostbiteLostHistoryTest, WithoutHitsItFadesOrIsRejected) {
    for (const bool is_rejected : {false, true}) {
        FrostbiteFilterBench bench(
            device(), view,
            {{"history_weight", 0.75}, {"neighborhood_clamp", false}, {"reject_without_hits", is_rejected}});
        bench.next(pose, wall_of_mirror, [](glm::uvec2, const CameraRay&) {
            return ResolvedPixel{.radiance = glm::vec3(5), .confidence = 1, .ray_length = 2};
        });
        HostImage found;
        for (int i = 0; i < 3; ++i)
            found = bench.next(pose, wall_of_mirror,
                               [](glm::uvec2, const CameraRay&) { return ResolvedPixel{.confidence = 0}; });
        for (size_t i = 0; i < found.pixel_count(); ++i) {
            EXPECT_NEAR(found.values[4 * i + 3], is_rejected ? 0 : 0.75 * 0.75 * 0.75, 1e-5);
            EXPECT_NEAR(found.values[4 * i], is_rejected ? 0 : 5, 1e-4);
        }
    }
}

/// Where misses see the environment, there is always something to blend with.
TEST_F(FrostbiteLostHistoryTest, WithoutHitsButWithAnEnvironmentItIsKept) {
    FrostbiteFilterBench bench(device(), view,
                               {{"history_weight", 0.75},
                                {"neighborhood_clamp", false},
                                {"reject_without_hits", true},
                                {"misses", "fallback"}});
    HostImage found;
    for (const float radiance : {5.0f, 1.0f, 1.0f, 1.0f})
        found = bench.next(pose, wall_of_mirror, [&](glm::uvec2, const CameraRay&) {
            return ResolvedPixel{.radiance = glm::vec3(radiance)};
        });
    for (size_t i = 0; i < found.pixel_count(); ++i)
        ASSERT_NEAR(found.values[4 * i], 1 + (5 - 1) * 0.75 * 0.75 * 0.75, 1e-4) << i;
}

// The clamp.

TEST_F(FrostbiteFilterTest, ClampsHistoryToTheExpandedBoxOfTheNeighbors) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(0, 1);
    HostImage before(view.extent, 4), now(view.extent, 4);
    for (float& v : before.values) v = 2 * uniform(random);
    for (float& v : now.values) v = uniform(random);
    for (size_t i = 3; i < before.values.size(); i += 4) before.values[i] *= 0.5f;  // confidence
    const auto pixel_of = [](const HostImage& image) {
        return [&](glm::uvec2 p, const CameraRay&) {
            const float* v = image.pixel(p.x, p.y);
            return ResolvedPixel{.radiance = {v[0], v[1], v[2]}, .confidence = v[3]};
        };
    };
    for (const float scale : {0.5f, 1.0f, 2.0f}) {
        FrostbiteFilterBench bench(device(), view, {{"history_weight", 1.0}, {"clamp_scale", scale}});
        bench.next(pose, wall_of_mirror, pixel_of(before));
        const HostImage found = bench.next(pose, wall_of_mirror, pixel_of(now));
        unsigned clamped = 0;
        for (int y = 0; y < int(view.extent.y); ++y)
            for (int x = 0; x < int(view.extent.x); ++x) {
                glm::vec4 low(1e9f), high(-1e9f);
                for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, int(view.extent.y) - 1); ++ny)
                    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, int(view.extent.x) - 1); ++nx) {
                        low = glm::min(low, weighed(now.pixel(unsigned(nx), unsigned(ny))));
                        high = glm::max(high, weighed(now.pixel(unsigned(nx), unsigned(ny))));
                    }
                const glm::vec4 center = (low + high) / 2.0f, reach = scale * (high - low) / 2.0f;
                const glm::vec4 history = weighed(before.pixel(unsigned(x), unsigned(y)));
                const glm::vec4 expected = glm::clamp(history, center - reach, center + reach);
                clamped += expected != history;
                const glm::vec4 shown = weighed(found.pixel(unsigned(x), unsigned(y)));
                // 1e-4 pixels of neighbours up to 2 apart, as above.
                for (int c = 0; c < 4; ++c) EXPECT_NEAR(shown[c], expected[c], 1e-3f) << x << ", " << y;
            }
        EXPECT_GT(clamped, 500u);
    }
}

}  // namespace
