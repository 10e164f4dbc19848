// The denoiser speed_accumulation, with rays that the tests make up, against closed forms.
#include "tests/variants/denoiser_bench.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

namespace {

struct SpeedAccumulationTest : TechniqueTest {
    static constexpr glm::uvec2 extent{16, 12}, middle{8, 6};
    static constexpr float wall_distance = 5;
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    float roughness = 0.1f;

    /// Faces the camera, whichever way that looks.
    SyntheticHit wall(const CameraRay& ray) const {
        const glm::vec3 towards_viewer(pose.world_from_view[2]);
        return {.distance = -wall_distance / dot(ray.direction, towards_viewer),
                .normal = towards_viewer,
                .roughness = roughness,
                .metalness = 1,
                .specular = 1};
    }
    DenoiserBench bench(const nlohmann::json& parameters) {
        return {device(),  "speed_accumulation", pose, extent, [this](const CameraRay& ray) { return wall(ray); },
                parameters};
    }
    static const float* middle_of(const HostImage& image) { return image.pixel(middle.x, middle.y); }

    /// Share of the new frame in the mean (A* of the law): white after three black ones.
    float share(DenoiserBench&& bench, const RayFrame& white) {
        for (int i = 0; i < 3; ++i) bench.next(of_one_color(0));
        return *middle_of(bench.next(white));
    }
};

const nlohmann::json plain = nlohmann::json::object();
constexpr double share_at_rest = 0.026278013;  // 2^(-7 * 0.75)

// From rays to pixels.

TEST_F(SpeedAccumulationTest, ConstantRadianceStays) {
    roughness = 0.6f;
    const nlohmann::json corrected = {
        {"ratio_estimator", true}, {"average_confidence", true}, {"reproject_history", true}, {"average_evenly", true}};
    for (const nlohmann::json& parameters : {plain, corrected}) {
        DenoiserBench constant = bench(parameters);
        for (unsigned frame = 0; frame < 6; ++frame) {
            RayFrame rays{.color = [](glm::uvec2) { return glm::vec3(2, 3, 4); },
                          .motion = [=](glm::uvec2) { return glm::vec2(2e-4f * float(frame), 0); }};
            rays.change = [](glm::uvec2 pixel, StoredRay& ray) {
                ray.direction = normalize(ray.direction + glm::vec3(0.1f * float(pixel.x % 3), 0, 0));
                ray.inverse_density = 1 + float(pixel.y % 4);
                ray.confidence = 0.5f;
            };
            const HostImage found = constant.next(rays);
            for (size_t i = 0; i < found.pixel_count(); ++i)
                for (int c = 0; c < 4; ++c) {
                    ASSERT_NEAR(found.values[4 * i + c], c == 3 ? 0.5f : float(c + 2), 1e-5f);
                }
        }
    }
}

/// Narrow lobes weigh neighbours alike: the mean of those that hit.
TEST_F(SpeedAccumulationTest, FiveRaysAreAveraged) {
    const auto color = [](glm::uvec2 pixel) { return glm::vec3(float(pixel.x * pixel.x + 10 * pixel.y)); };
    const float own = 64 + 60, right = 81 + 60, left = 49 + 60, upper = 64 + 50, lower = 64 + 70;
    const auto missing = [&](glm::uvec2 miss) {
        RayFrame rays{.color = color};
        rays.change = [=](glm::uvec2 pixel, StoredRay& ray) {
            if (pixel == miss) ray.target = ray_missed;
        };
        return rays;
    };
    const auto first = [&](const nlohmann::json& parameters, glm::uvec2 miss) {
        const HostImage found = bench(parameters).next(missing(miss));
        return glm::vec2(middle_of(found)[0], middle_of(found)[3]);
    };
    const glm::uvec2 none(0, 0), left_one = middle - glm::uvec2(1, 0);
    const float all = (own + right + left + upper + lower) / 5, but_left = (own + right + upper + lower) / 4;
    EXPECT_NEAR(first(plain, none).x, all, 1e-2);
    EXPECT_NEAR(first(plain, left_one).x, but_left, 1e-2);
    EXPECT_NEAR(first(plain, left_one).y, 1, 1e-5);
    EXPECT_EQ(first(plain, middle), glm::vec2(0));
    const nlohmann::json averaged = {{"average_confidence", true}};
    EXPECT_NEAR(first(averaged, left_one).y, 0.8, 1e-5);
    EXPECT_NEAR(first(averaged, middle).x, (right + left + upper + lower) / 4, 1e-2);
    EXPECT_NEAR(first({{"reuse_neighbors", false}}, none).x, own, 1e-4);
}

TEST_F(SpeedAccumulationTest, MirrorsPassTheirOwnRayThrough) {
    roughness = 0;
    const auto color = [](glm::uvec2 pixel) { return glm::vec3(float(pixel.x), float(pixel.y), 1); };
    const HostImage found = bench(plain).next({.color = color});
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const glm::vec4 own(x, y, 1, 1);
            for (int c = 0; c < 4; ++c) ASSERT_NEAR(found.pixel(x, y)[c], own[c], 1e-5f) << x << ", " << y;
        }
}

/// For alpha = 1, masking and shadowing over masking is c (1 + v) / (c + v) of the cosines c of the ray and v of the
/// view. Seen along the normal, v is 1 however the camera is turned; the original takes cosines to the world's z axis.
/// The whole lobe over a density p is in proportion to c / (1 + c) / p.
TEST_F(SpeedAccumulationTest, WeightsAreThoseOfTheLobe) {
    roughness = 1;
    pose.is_orthographic = true;
    pose.world_from_view = glm::rotate(glm::mat4(1), glm::quarter_pi<float>(), glm::vec3(0, 1, 0));
    const double left_cosine = 0.3, left_sine = std::sqrt(0.91), left_inverse_density = 7;
    const auto mean = [&](const nlohmann::json& parameters) {
        RayFrame rays{.color = [](glm::uvec2 pixel) { return glm::vec3(pixel.x < middle.x); }};
        rays.change = [=](glm::uvec2 pixel, StoredRay& ray) {
            ray.length = 1e5f;  // from where it is seen alike by all
            if (pixel.x >= middle.x) return;
            ray.direction = {left_sine, 0, left_cosine};
            ray.inverse_density = float(left_inverse_density);
        };
        return *middle_of(bench(parameters).next(rays));  // of one on the left, and four with cosine and density 1
    };
    const auto weight = [](double c, double v) { return c * (1 + v) / (c + v); };
    const double half = std::sqrt(0.5), tilted = half * (left_sine - left_cosine), of_left = weight(left_cosine, 1);
    EXPECT_NEAR(mean(plain), weight(tilted, half) / (weight(tilted, half) + 4 * weight(half, half)), 1e-5);
    EXPECT_NEAR(mean({{"local_frame", true}}), of_left / (of_left + 4), 1e-5);
    EXPECT_NEAR(mean({{"ratio_estimator", true}}),
                of_left * left_inverse_density / (of_left * left_inverse_density + 4), 1e-4);
}

// History.

/// After k frames of a step, 1 - (1 - A)^k of it; before that the third frame alone is kept.
TEST_F(SpeedAccumulationTest, AtRestTheMeanIsExponential) {
    for (const auto& [accumulation, expected_share] :
         {std::pair(0.75, share_at_rest), {0.25, 0.29730178}, {0.0, 1.0}}) {
        DenoiserBench step = bench({{"accumulation", accumulation}});
        for (const float value : {9.0f, 7.0f, 0.0f})
            EXPECT_NEAR(*middle_of(step.next(of_one_color(value))), value, 1e-5);
        for (int k = 1; k <= 8; ++k)
            EXPECT_NEAR(*middle_of(step.next(of_one_color(1))), 1 - std::pow(1 - expected_share, k), 1e-5) << k;
    }
}

/// What was seen fades, and keeps its colour.
TEST_F(SpeedAccumulationTest, MissesTakeConfidenceAlone) {
    DenoiserBench fading = bench(plain);
    RayFrame misses;
    misses.change = [](glm::uvec2, StoredRay& ray) { ray.target = ray_missed; };
    for (int i = 0; i < 3; ++i) fading.next(of_one_color(5));
    for (int k = 1; k <= 4; ++k) {
        const HostImage found = fading.next(misses);
        EXPECT_NEAR(middle_of(found)[0], 5, 1e-5);
        EXPECT_NEAR(middle_of(found)[3], std::pow(1 - share_at_rest, k), 1e-5);
    }
}

TEST_F(SpeedAccumulationTest, AveragesEvenlySinceTheLastRejection) {
    DenoiserBench even = bench({{"average_evenly", true}});
    for (int n = 1; n <= 6; ++n) EXPECT_NEAR(*middle_of(even.next(of_one_color(float(n)))), 0.5 * (n + 1), 1e-5);
    RayFrame fast = of_one_color(10);
    fast.motion = [](glm::uvec2) { return glm::vec2(0.1f, 0); };
    EXPECT_NEAR(*middle_of(even.next(fast)), 10, 1e-5);
    EXPECT_NEAR(*middle_of(even.next(of_one_color(20))), 15, 1e-5);
}

// How speed rejects it.

/// The surface moves by `surface`, the pixel that all rays hit, which no ray starts from, by `target` (uv per frame).
RayFrame moving(glm::vec2 surface, glm::vec2 target) {
    const glm::uvec2 hit(15, 11);
    RayFrame rays = of_one_color(1);
    rays.motion = [=](glm::uvec2 pixel) { return pixel == hit ? target : surface; };
    rays.change = [=](glm::uvec2, StoredRay& ray) { ray.target = packed(hit); };
    return rays;
}

double mixed(double rejected) { return share_at_rest + (1 - share_at_rest) * rejected; }

TEST_F(SpeedAccumulationTest, TheWayOnTheScreenRejects) {
    const glm::vec2 surface(3e-4f, 4e-4f), target(0, -2.5e-4f);
    EXPECT_NEAR(share(bench(plain), moving(surface, target)), mixed(640 * 7.5e-4), 1e-4);
    EXPECT_NEAR(share(bench(plain), moving(2.0f * surface, 2.0f * target)), mixed(640 * 1.5e-3), 1e-4);
    EXPECT_NEAR(share(bench(plain), moving(3.0f * surface, 3.0f * target)), 1, 1e-5);
    EXPECT_NEAR(share(bench({{"speed_of", "surface"}}), moving(surface, target)), mixed(640 * 5e-4), 1e-4);
    EXPECT_NEAR(share(bench({{"speed_of", "target"}}), moving(surface, target)), mixed(640 * 2.5e-4), 1e-4);
    EXPECT_NEAR(share(bench({{"speed_rejection", 0.25}}), moving(surface, target)), mixed(320 * 7.5e-4), 1e-4);
    const nlohmann::json legacy = {{"rejection", "legacy_screen"}, {"speed_rejection", 0.0}};
    EXPECT_NEAR(share(bench(legacy), moving(4.0f * surface, 4.0f * target)), mixed(128 * 3e-3), 1e-4);
    EXPECT_NEAR(share(bench(legacy), moving(11.0f * surface, 11.0f * target)), 1, 1e-5);
}

/// A way of d uv across the wall is half of d times its height in view, grown by far / (far - distance); the largest
/// speed is 0.0004 m per frame.
TEST_F(SpeedAccumulationTest, TheWayInSpaceRejects) {
    const float per_uv = std::tan(pose.vertical_fov / 2) * wall_distance * pose.far / (pose.far - wall_distance);
    const auto way = [&](float metres) { return glm::vec2(0, metres / per_uv); };
    const nlohmann::json hard = {{"rejection", "world_hard"}}, smooth = {{"rejection", "world_smooth"}};
    EXPECT_NEAR(share(bench(hard), moving(way(1.2e-4f), way(0.7e-4f))), share_at_rest, 1e-4);
    EXPECT_NEAR(share(bench(hard), moving(way(1.2e-4f), way(0.9e-4f))), 1, 1e-5);
    EXPECT_NEAR(share(bench(smooth), moving(way(1.2e-4f), way(0.8e-4f))), mixed(0.5 * 0.5), 1e-3);
    EXPECT_NEAR(share(bench(smooth), moving(way(1), way(0))), mixed(0.5), 1e-4) << "it never rejects all";
    EXPECT_NEAR(share(bench(smooth), moving(way(1), way(-1))), share_at_rest, 1e-4) << "opposite ways cancel";
    EXPECT_NEAR(
        share(bench({{"rejection", "world_smooth"}, {"add_speeds", true}}), moving(way(1.2e-4f), way(-0.8e-4f))),
        mixed(0.5 * 0.5), 1e-3);
}

/// The screen's first pixel moves, twice as near as the wall.
TEST_F(SpeedAccumulationTest, TheFirstPixelRejectsOnlyInTheOriginal) {
    const glm::vec2 step(0, 4e-4f);
    RayFrame misses = of_one_color(1);
    misses.motion = [=](glm::uvec2 pixel) { return pixel == glm::uvec2(0) ? step : glm::vec2(0); };
    misses.change = [](glm::uvec2, StoredRay& ray) { ray.target = ray_missed; };
    // No confidence is new: 1 - A* of it is left.
    const auto left = [&](const nlohmann::json& parameters) {
        DenoiserBench fading = bench(parameters);
        for (int i = 0; i < 3; ++i) fading.next(of_one_color(1));
        return middle_of(fading.next(misses))[3];
    };
    EXPECT_NEAR(left(plain), 1 - mixed(640 * 4e-4), 1e-4);
    EXPECT_NEAR(left({{"misses_stand_still", true}}), 1 - share_at_rest, 1e-4);

    const SyntheticScene with_corner = [&](const CameraRay& ray) {
        SyntheticHit hit = wall(ray);
        const glm::vec2 edge = glm::vec2(camera_ray(pose, extent, {1, 1}).direction);
        if (ray.direction.x < edge.x && ray.direction.y > edge.y) hit.distance /= 2;
        return hit;
    };
    for (const bool is_corrected : {false, true}) {
        const float distance = is_corrected ? wall_distance : wall_distance / 2;
        const float per_uv = std::tan(pose.vertical_fov / 2) * distance * pose.far / (pose.far - distance);
        DenoiserBench target(
            device(), "speed_accumulation", pose, extent, with_corner,
            {{"rejection", "world_smooth"}, {"speed_of", "target"}, {"depth_of_target", is_corrected}});
        EXPECT_NEAR(share(std::move(target), moving({0, 0}, {0, 1e-4f / per_uv})), mixed(0.25 * 0.5), 1e-3);
    }
}

/// A wall that slides by two pixels within its plane takes its history along, and shows new pixels at one side.
TEST_F(SpeedAccumulationTest, HistoryMovesWithTheSurface) {
    const auto color = [](glm::uvec2 pixel) { return glm::vec3(float(pixel.x * pixel.x)); };
    for (const bool is_corrected : {false, true}) {
        DenoiserBench sliding =
            bench({{"reproject_history", is_corrected}, {"speed_rejection", 0.0}, {"reuse_neighbors", false}});
        for (int i = 0; i < 3; ++i) sliding.next({.color = color});
        RayFrame black = of_one_color(0);
        black.motion = [](glm::uvec2) { return glm::vec2(2.0f / extent.x, 0); };
        const HostImage found = sliding.next(black);
        for (unsigned x = 0; x < extent.x; ++x) {
            const float before = is_corrected ? float(x) - 2 : float(x);
            const double history = before < 0 ? 0 : before * before * (1 - share_at_rest);
            EXPECT_NEAR(*found.pixel(x, 6), history, 1e-2) << x;
        }
    }
}

// Whatever comes in.

TEST_F(SpeedAccumulationTest, ExtremesStayFinite) {
    const float infinite = std::numeric_limits<float>::infinity(), largest = std::numeric_limits<float>::max();
    const std::vector<float> values = {0, 1, -1, 1e-38f, largest, infinite, -infinite, std::nanf("")};
    std::mt19937 random(3);
    const auto any_of = [&](std::span<const float> from) { return from[random() % from.size()]; };
    nlohmann::json all = {{"rejection", "world_smooth"}};
    for (const char* name : {"ratio_estimator", "average_confidence", "add_speeds", "depth_of_target",
                             "reproject_history", "average_evenly", "misses_stand_still"})
        all[name] = true;
    nlohmann::json without_motion = all;
    without_motion["reproject_history"] = false;
    for (const nlohmann::json& parameters : {plain, without_motion, all}) {
        for (const glm::uvec2 size : {glm::uvec2(1), extent}) {
            pose.is_orthographic = size.x > 1;
            const SyntheticScene scene = [&](const CameraRay& ray) {
                SyntheticHit hit = wall(ray);
                hit.roughness = ray.direction.x + ray.origin.x < 0 ? 0.0f : 1.0f;
                return hit;
            };
            DenoiserBench extremes(device(), "speed_accumulation", pose, size, scene, parameters);
            for (int frame = 0; frame < 5; ++frame) {
                RayFrame rays{.color = [&](glm::uvec2) { return glm::vec3(any_of(values), any_of(values), 1); },
                              .motion = [&](glm::uvec2) { return glm::vec2(any_of(values), 0); }};
                rays.change = [&](glm::uvec2, StoredRay& ray) {
                    ray.inverse_density = any_of(std::vector{0.0f, 1e-30f, 1.0f, 1e30f});
                    ray.confidence = any_of(std::vector{0.0f, 1e-30f, 1.0f});
                    ray.length = any_of(std::vector{0.0f, 1.0f, 1e30f});
                    if (random() % 4 == 0) ray.target = ray_missed - random() % 3;
                };
                const HostImage found = extremes.next(rays);
                for (size_t i = 0; i < found.values.size(); ++i) {
                    ASSERT_TRUE(std::isfinite(found.values[i]));
                    ASSERT_GE(found.values[i], 0);
                    if (i % 4 == 3) {
                        ASSERT_LE(found.values[i], 1);
                    }
                }
            }
        }
    }
}

}  // namespace
