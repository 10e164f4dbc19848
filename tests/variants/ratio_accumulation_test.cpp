// The denoiser ratio_accumulation, with rays that the tests make up, against closed forms.
#include "tests/variants/changed.h"
#include "tests/variants/probe_lookup.h"
#include "tests/variants/ratio_accumulation_fixture.h"

#include <glm/gtc/constants.hpp>
#include <limits>

namespace {

const nlohmann::json defaults = nlohmann::json::object();
constexpr double least_ratio = 0.01;  // the default

/// Whatever directions, densities and confidences rays have; up to the rounding of sums.
TEST_F(RatioAccumulationTest, ConstantRadianceStays) {
    for (const float of_wall : {0.0f, 0.3f, 0.8f})
        for (const bool is_moving : {false, true}) {
            roughness = of_wall;
            DenoiserBench constant = bench(defaults, {{"half_resolution", is_moving}});
            size_t known = 0;
            for (int frame = 0; frame < 8; ++frame) {
                if (is_moving) move_to(constant, float(frame) * glm::vec3(0.2f, 0.1f, -0.1f));
                RayFrame rays{.color = [](glm::uvec2) { return glm::vec3(2, 3, 4); }};
                rays.change = [&](glm::uvec2, StoredRay& ray) {
                    ray.direction += glm::vec3(uniform(random), uniform(random), uniform(random)) - 0.5f;
                    ray.direction = glm::normalize(ray.direction);
                    ray.inverse_density = std::exp(8 * (uniform(random) - 0.5f));
                    ray.length = 10 * uniform(random);
                    ray.confidence = uniform(random);
                    if (random() % 4 == 0) ray.target = ray_missed;
                };
                const HostImage found = constant.next(rays);
                for (size_t i = 0; i < found.pixel_count(); ++i) {
                    ASSERT_GE(found.values[4 * i + 3], 0);
                    ASSERT_LE(found.values[4 * i + 3], 1);
                    if (found.values[4 * i + 3] == 0) continue;
                    ++known;
                    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found.rgb(i)[c], float(c + 2), 1e-4f) << of_wall;
                }
            }
            EXPECT_GT(known, 7u * extent.x * extent.y) << "of eight times as many";
        }
}

/// Colours are from 0 to 1, so that the share of other pixels' rays is what they make at most. A mirror's neighbours, a
/// pixel away, have ratios below 1e-4.
TEST_F(RatioAccumulationTest, MirrorsShowTheirOwnRays) {
    roughness = 0;
    const HostImage colors = any_colors();
    for (const double least : {least_ratio, 0.0})
        for (const bool half : {false, true}) {
            DenoiserBench mirror = bench({{"least_ratio", least}}, {{"half_resolution", half}});
            for (int frame = 1; frame <= 12; ++frame) {
                const HostImage found = mirror.next(drawn(colors));
                if (half && frame % 4 != 0) continue;  // not every pixel has had its turn as often
                const double rays = half ? 12 : 3;     // among them one of the pixel's own
                const double others = (rays - 1) * least / (1 + rays * least) + 1e-3;
                for (size_t i = 0; i < found.pixel_count(); ++i)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(found.rgb(i)[c], colors.rgb(i)[c], others) << frame << ", pixel " << i;
            }
        }
}

/// Of alpha 1, seen straight, the lobe has the same density, 1 / (4 pi), everywhere. Half of the rays are uniform over
/// the hemisphere, half as dense as their cosine c, which is what they see: of the density (1/2 + c) / (2 pi) the ratio
/// is 1 / (1 + 2 c). The mean of c over the lobe is 1/2, and over the rays, which have least_ratio alike, 7/12. A ratio
/// of sums of n rays is 0.099 / n too large, and its variance is 0.0986 / n: integrals of (c - 1/2) w^2 and (c - 1/2)^2
/// w^2 over the rays, by the square of the mean weight. 5 standard errors: a false alarm in a million.
TEST_F(RatioAccumulationTest, MeanIsThatOfTheLobe) {
    extent = {32, 32};
    pose.is_orthographic = true, pose.orthographic_height = 4;
    roughness = 1;
    DenoiserBench rough = bench(of_means);
    const unsigned frames = 60, pixels = extent.x * extent.y;
    RayFrame rays{.color = [&](glm::uvec2 pixel) {
        return glm::vec3((float(pixel.y * extent.x + pixel.x) + 0.5f) / float(pixels));
    }};
    rays.change = [&](glm::uvec2, StoredRay& ray) {
        const float u = uniform(random), c = random() % 2 ? u : std::sqrt(u), s = std::sqrt(1 - c * c),
                    turn = 2 * glm::pi<float>() * uniform(random);
        const unsigned shown = std::min(unsigned(c * float(pixels)), pixels - 1);
        ray.direction = {s * std::cos(turn), s * std::sin(turn), c};
        ray.inverse_density = 2 * glm::pi<float>() / (0.5f + c);
        ray.target = packed({shown % extent.x, shown / extent.x});
    };
    HostImage found;
    for (unsigned frame = 0; frame < frames; ++frame) found = rough.next(rays);
    const double expected = (0.5 * 0.5 + least_ratio * 7 / 12) / (0.5 + least_ratio) + 0.099 / frames;
    EXPECT_NEAR(spread_of(found).mean, expected, 5 * std::sqrt(0.0986 / frames / pixels));
}

/// n independent colours have 1/n of their variance, 1/12. From max_history on each new one has the share s of the sum,
/// and what stays is s / (2 - s). Of 3072 values the variance has a standard error of 2.6 %: 15 % are 5.8 of them, a
/// false alarm in 10^8.
TEST_F(RatioAccumulationTest, VarianceFallsWithFramesUpToMaxHistory) {
    extent = {32, 32};
    roughness = 1;
    nlohmann::json own = of_means;
    own["max_history"] = 16;
    DenoiserBench noisy = bench(own);
    const double weight = 1 + least_ratio, share = weight / (16 + weight);
    for (int frame = 1; frame <= 80; ++frame) {
        const HostImage colors = any_colors();
        const double variance = 12 * spread_of(noisy.next(drawn(colors))).variance;
        if (frame == 1 || frame == 4 || frame == 15) {
            EXPECT_NEAR(variance * frame, 1, 0.15) << frame;
        }
        if (frame == 80) {
            EXPECT_NEAR(variance / (share / (2 - share)), 1, 0.15);
        }
    }
}

/// Numbers of 16 bits are up to 2^-10 apart: cut off in every frame, they would make a history of 160 rays up to 160
/// times that too dark. Rounded at random, the mean of 1024 pixels is a hundred times closer.
TEST_F(RatioAccumulationTest, HistoriesOf16BitsKeepTheMean) {
    extent = {32, 32};
    roughness = 1;
    nlohmann::json own = of_means;
    DenoiserBench exact = bench(own);
    own["float_histories"] = false;
    DenoiserBench rounded = bench(own);
    for (int frame = 1; frame <= 300; ++frame) {
        const HostImage colors = any_colors();
        const double expected = spread_of(exact.next(drawn(colors))).mean;
        ASSERT_NEAR(spread_of(rounded.next(drawn(colors))).mean / expected, 1, 1e-3) << frame;
    }
}

/// The middle of the lobe is the normal of roughness 1; of less it lies between that and the mirrored view, and so does
/// what is seen there, up to what it changes by from one of 40 steps to the next. The camera is away from the origin,
/// and turned.
TEST_F(RatioAccumulationTest, RoughSurfacesShowTheProbe) {
    pose.world_from_view = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(1, 0.5f, 2)), 0.5f, glm::vec3(0, 1, 0));
    const SyntheticScene half_a_wall = [this](const CameraRay& ray) {
        SyntheticHit hit = wall(ray);
        const glm::vec3 p = ray.origin + hit.distance * ray.direction;
        if (hit.distance < 0 || p.x > 0) return SyntheticHit{};
        hit.lit = glm::vec3(3 + std::sin(p.x), 2, 1 + std::sin(p.y));
        return hit;
    };
    for (const float of_wall : {0.6f, 1.0f})
        for (const bool half : {false, true}) {
            roughness = of_wall;
            const int steps = roughness < 1 ? 41 : 1;
            const nlohmann::json draw = {{"max_roughness", 0.5}, {"half_resolution", half}};
            const HostImage without_probe =
                DenoiserBench(device(), "ratio_accumulation", pose, extent, half_a_wall, defaults, draw)
                    .next(of_one_color(7));
            for (const float value : without_probe.values) ASSERT_EQ(value, 0);
            DenoiserBench rough(device(), "ratio_accumulation", pose, extent, half_a_wall, defaults,
                                changed(draw, {{"misses", "probe"}}));
            const HostImage found = rough.next(of_one_color(7));
            std::vector<ProbeRay> rays;
            std::vector<glm::vec4> shown;
            for (unsigned y = 0; y < extent.y; ++y)
                for (unsigned x = 0; x < extent.x; ++x) {
                    const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f);
                    const SyntheticHit hit = half_a_wall(ray);
                    const float* p = found.pixel(x, y);
                    if (std::isinf(hit.distance)) {
                        ASSERT_EQ(p[3], 0);
                        continue;
                    }
                    const glm::vec3 mirrored = reflect(ray.direction, hit.normal);
                    for (int step = 0; step < steps; ++step)
                        rays.push_back({hit.distance * ray.direction,
                                        glm::normalize(glm::mix(hit.normal, mirrored, float(step) / 40))});
                    shown.emplace_back(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
                }
            ASSERT_GT(shown.size(), extent.x * extent.y / 4);
            const std::vector<glm::vec4> expected = look_up(rough.pass_list, *rough.probe, rays);
            for (size_t i = 0; i < shown.size(); ++i) {
                glm::vec4 least = expected[i * steps], most = least;
                for (int step = 1; step < steps; ++step) {
                    least = glm::min(least, expected[i * steps + step]);
                    most = glm::max(most, expected[i * steps + step]);
                }
                const float between = 1e-3f + (steps > 1 ? 0.02f : 0.0f);
                for (int c = 0; c < 4; ++c) {
                    ASSERT_GE(shown[i][c], least[c] - between);
                    ASSERT_LE(shown[i][c], most[c] + between);
                }
            }
        }
}

/// In the first of ten frames most rays see what is no number, which counts as black.
TEST_F(RatioAccumulationTest, NumbersAloneStay) {
    const float infinite = std::numeric_limits<float>::infinity();
    const float none[] = {std::nanf(""), infinite, -infinite, 1};
    for (const bool reuses : {false, true}) {
        DenoiserBench broken = bench({{"change_deviations", 0.0}, {"reuse_neighbors", reuses}});
        HostImage found;
        for (int frame = 0; frame < 10; ++frame) {
            found = broken.next(drawn([&](glm::uvec2) { return glm::vec3(frame == 0 ? none[random() % 4] : 1); }));
            for (const float value : found.values) ASSERT_TRUE(std::isfinite(value)) << frame;
        }
        for (size_t i = 0; i < found.pixel_count(); ++i) {
            const float shown = found.rgb(i).r, black = 1 - shown;
            // Neighbours' ratios are from 0 to 1: the first frame has at most 3 of 3 + 9.
            ASSERT_LE(black, (reuses ? 0.25f : 0.1f) + 1e-4f);
            ASSERT_GE(black, -1e-5f);
            if (!reuses) {
                ASSERT_LE(std::min(black, 0.1f - black), 1e-4f);
            }
        }
    }
}

TEST_F(RatioAccumulationTest, ExtremesStayFinite) {
    const float largest = std::numeric_limits<float>::max();
    const std::vector<float> values = {0, 1, -1, 1e-38f, largest, 2 * largest, std::nanf("")};
    const auto any_of = [&](const std::vector<float>& from) { return from[random() % from.size()]; };
    for (const glm::uvec2 size : {glm::uvec2(1), glm::uvec2(15, 11)})
        for (const bool half : {false, true}) {
            extent = size;
            pose.is_orthographic = half;
            DenoiserBench extremes = bench(defaults, {{"half_resolution", half}, {"max_rays", 1}});
            for (int frame = 0; frame < 6; ++frame) {
                roughness = any_of({0, 0.3f, 1});
                move_to(extremes, {any_of({0, 0.1f, 100}), 0, 0});
                RayFrame rays{.color = [&](glm::uvec2) { return glm::vec3(any_of(values), any_of(values), 1); },
                              .motion = [&](glm::uvec2) { return glm::vec2(any_of(values), 0); }};
                rays.change = [&](glm::uvec2, StoredRay& ray) {
                    ray.inverse_density = any_of({0, 1e-30f, 1, 1e30f, largest});
                    ray.confidence = any_of({0, 1e-30f, 1});
                    ray.length = any_of({0, 1, 1e30f});
                    if (random() % 4 == 0) ray.target = ray_missed - random() % 3;
                };
                const HostImage found = extremes.next(rays);
                for (size_t i = 0; i < found.values.size(); ++i) {
                    ASSERT_TRUE(std::isfinite(found.values[i]));
                    ASSERT_GE(found.values[i], 0);
                    ASSERT_LE(found.values[i], i % 4 == 3 ? 1 : largest);
                }
            }
        }
}

}  // namespace
