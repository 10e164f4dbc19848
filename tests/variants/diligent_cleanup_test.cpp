// DiligentFX's bilateral cleanup against its formula, evaluated pixel by pixel in double precision.
#include "core/scene/camera.h"
#include "tests/variants/accumulation_bench.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <random>

namespace {

using Overrides = nlohmann::json;

constexpr glm::uvec2 extent{32, 24};
const float threshold = 0.5f;  // of roughness

/// A slanted surface. No two pixels of a kernel are equally far, where the formula would compare what rounding leaves.
struct DiligentCleanup : TechniqueTest {
    const glm::vec2 slope{0.05f, 0.015f};  // m per pixel
    CleanupInputs inputs;

    float distance(unsigned x, unsigned y) const { return 5 + slope.x * float(x) + slope.y * float(y); }

    void SetUp() override {
        inputs.camera = camera_data(CameraPose{.near = 1}, nullptr, {.extent = extent});
        inputs.depth = HostImage(extent, 1);
        inputs.normal = HostImage(extent, 4);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const glm::vec4 clip = inputs.camera.clip_from_view * glm::vec4(0, 0, -distance(x, y), 1);
                *inputs.depth.pixel(x, y) = clip.z / clip.w;
                inputs.normal.pixel(x, y)[2] = 1;
            }
        inputs.mask = HostImage(extent, 1, 1.0f);
        inputs.roughness = HostImage(extent, 1, 0.3f);
        inputs.accumulated = {.radiance = HostImage(extent, 4), .variance = HostImage(extent, 1, 0.01f)};
        std::mt19937 random(1);
        for (float& value : inputs.accumulated.radiance.values) value = float(random() % 1024) / 1024;
    }

    HostImage run(Overrides overrides) {
        overrides.emplace("float_histories", true);
        overrides.emplace("roughness_threshold", threshold);
        return AccumulationBench(device(), extent, overrides).clean_up(inputs);
    }

    int radius(glm::ivec2 pixel, double sigma) const {
        const float variance = *inputs.accumulated.variance.pixel(unsigned(pixel.x), unsigned(pixel.y)),
                    roughness = *inputs.roughness.pixel(unsigned(pixel.x), unsigned(pixel.y));
        return variance > 1e-3 ? int(std::min(2 * sigma, 2 * std::min(8.0 * roughness, 1.0))) : 0;
    }

    double weight(glm::uvec2 pixel, glm::uvec2 neighbor, glm::ivec2 offset, double sigma) const {
        const bool is_far = *inputs.depth.pixel(neighbor.x, neighbor.y) == 1;
        if (*inputs.roughness.pixel(neighbor.x, neighbor.y) > threshold || is_far) return 0;
        const double expected_change = slope.x * offset.x + slope.y * offset.y;
        const double change = distance(pixel.x, pixel.y) - distance(neighbor.x, neighbor.y);
        double cosine = 0;
        for (int i = 0; i < 3; ++i)
            cosine += inputs.normal.pixel(pixel.x, pixel.y)[i] * inputs.normal.pixel(neighbor.x, neighbor.y)[i];
        return std::exp(-(offset.x * offset.x + offset.y * offset.y) / (2 * sigma * sigma)) *
               std::exp(-std::abs(change) / (std::abs(expected_change) + 1e-6)) * std::pow(std::max(cosine, 0.0), 128);
    }

    glm::dvec4 expected(glm::ivec2 pixel, double sigma) const {
        glm::dvec4 sum(0);
        double weights = 0;
        const int reach = radius(pixel, sigma);
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const glm::uvec2 neighbor = glm::clamp(pixel + glm::ivec2(x, y), glm::ivec2(0), glm::ivec2(extent) - 1);
                const double w = reach > 0 ? weight(pixel, neighbor, {x, y}, sigma) : 1;
                for (int c = 0; c < 4; ++c) sum[c] += w * inputs.accumulated.radiance.pixel(neighbor.x, neighbor.y)[c];
                weights += w;
            }
        return sum / weights;
    }

    /// Distances of 7 m are rounded to 3e-6 m, of a slope of 0.015 m: 2e-4 of the exponent, twice.
    void expect_formula(double sigma) {
        const HostImage found = run({{"bilateral_cleanup_spatial_sigma_factor", sigma}});
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_NEAR(found.pixel(x, y)[c], expected({x, y}, sigma)[c], 1e-3)
                        << x << ", " << y << ", sigma " << sigma;
    }
};

/// Radius 1 at the default, 2 from a deviation of 1 on; at the border the nearest pixels count again. Kernels without
/// gates determine every weight.
TEST_F(DiligentCleanup, FiltersAsItsFormulaSays) {
    for (const double sigma : {0.9, 1.5, 4.0}) expect_formula(sigma);
}

/// What is a line in depth over a window stays as it is, the less the guide's epsilon counts; noise on it is averaged
/// over windows of windows; nothing crosses an edge of depth that is steep beside epsilon.
TEST_F(DiligentCleanup, GuidedFilterKeepsWhatDepthExplains) {
    const Overrides guided = {
        {"cleanup", "guided"}, {"bilateral_cleanup_spatial_sigma_factor", 1.0}, {"guided_epsilon", 1e-4}};
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (unsigned c = 0; c < 4; ++c)
                inputs.accumulated.radiance.pixel(x, y)[c] = 0.1f * float(c + 1) * distance(x, y);
    const HostImage line = run(guided);
    for (unsigned y = 3; y + 3 < extent.y; ++y)
        for (unsigned x = 3; x + 3 < extent.x; ++x)
            for (unsigned c = 0; c < 3; ++c)
                ASSERT_NEAR(line.pixel(x, y)[c], 0.1f * float(c + 1) * distance(x, y), 2e-4) << x << ", " << y;

    // Steps of colour and of 1 m of depth at the same column.
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const glm::vec4 clip = inputs.camera.clip_from_view * glm::vec4(0, 0, x < 16 ? -5 : -6, 1);
            *inputs.depth.pixel(x, y) = clip.z / clip.w;
            for (unsigned c = 0; c < 4; ++c) inputs.accumulated.radiance.pixel(x, y)[c] = x < 16 ? 1 : 3;
        }
    const HostImage step = run(guided);
    for (unsigned x = 0; x < extent.x; ++x) ASSERT_NEAR(step.pixel(x, 12)[0], x < 16 ? 1 : 3, 1e-4) << x;

    // White noise on a plane that faces the camera: a window of windows of 5x5, weights (1 2 3 4 5 4 3 2 1) / 25 each
    // way, whose squares add up to 0.0185. About the mean of 308 pixels that share neighbours 0.0160 is left of it,
    // with a standard deviation of 0.0061 (200 such images). Of 16 images five standard errors: one false alarm in a
    // million.
    SetUp();
    for (float& depth : inputs.depth.values) depth = inputs.depth.values[0];
    const auto variance_of = [](const HostImage& image, unsigned channel) {
        double sum = 0, squares = 0, count = 0;
        for (unsigned y = 5; y + 5 < extent.y; ++y)
            for (unsigned x = 5; x + 5 < extent.x; ++x) {
                const double v = image.pixel(x, y)[channel];
                sum += v, squares += v * v, ++count;
            }
        return squares / count - sum * sum / count / count;
    };
    double left = 0;
    std::mt19937 random(2);
    for (int repetition = 0; repetition < 4; ++repetition) {
        for (float& value : inputs.accumulated.radiance.values) value = float(random() % 1024) / 1024;
        const HostImage found = run(guided);
        for (unsigned channel = 0; channel < 4; ++channel)
            left += variance_of(found, channel) / variance_of(inputs.accumulated.radiance, channel) / 16;
    }
    EXPECT_NEAR(left, 0.0160, 5 * 0.0061 / 4);
    EXPECT_EQ(run({{"cleanup", "guided"}, {"bilateral_cleanup", false}}).values,
              run({{"bilateral_cleanup", false}}).values);
}

/// A deviation d makes d / (d + 0.1) of the kernel's: 0.9 of it for 0.9, half of it for 0.1, nothing for 0.
TEST_F(DiligentCleanup, SigmaFollowsTheVarianceIfAsked) {
    for (const auto& [variance, share] : {std::pair(0.81f, 0.9), {0.01f, 0.5}}) {
        inputs.accumulated.variance = HostImage(extent, 1, variance);
        for (const double factor : {2.0, 4.0}) {
            const HostImage found =
                run({{"sigma_from_variance", true}, {"bilateral_cleanup_spatial_sigma_factor", factor}});
            const HostImage expected = run({{"bilateral_cleanup_spatial_sigma_factor", share * factor}});
            for (size_t i = 0; i < found.values.size(); ++i) ASSERT_NEAR(found.values[i], expected.values[i], 1e-5);
        }
    }
    inputs.accumulated.variance = HostImage(extent, 1, 0.0f);
    EXPECT_EQ(run({{"sigma_from_variance", true}}).values, run({{"bilateral_cleanup", false}}).values);
    inputs.accumulated.variance = HostImage(extent, 1, 0.81f);
    EXPECT_NE(run({{"sigma_from_variance", true}}).values, run({{"bilateral_cleanup", false}}).values);
}

/// Roughness in strips about 1/16 and 1/8, where the radius becomes 1 and 2, and above the threshold; variance on
/// either side of its gate.
TEST_F(DiligentCleanup, GatesByVarianceAndRoughness) {
    const float roughness[] = {0.06f, 0.07f, 0.12f, 0.13f, 0.6f};
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            *inputs.roughness.pixel(x, y) = roughness[x / 3 % 5];
            *inputs.accumulated.variance.pixel(x, y) = y < 12 ? 1.1e-3f : 0.9e-3f;
            inputs.mask.pixel(x, y)[0] = roughness[x / 3 % 5] <= threshold;
        }
    const HostImage found = run({{"bilateral_cleanup_spatial_sigma_factor", 2.0}});
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const glm::dvec4 value = inputs.mask.pixel(x, y)[0] == 1 ? expected({x, y}, 2.0) : glm::dvec4(0);
            ASSERT_NEAR(found.pixel(x, y)[0], value[0], 1e-3) << x << ", " << y;
        }
}

/// Normals that turn by 4 degrees from column to column, and a few pixels of background.
TEST_F(DiligentCleanup, StopsAtNormalsAndBackground) {
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const float angle = 0.07f * float(x);
            inputs.normal.pixel(x, y)[0] = std::sin(angle);
            inputs.normal.pixel(x, y)[2] = std::cos(angle);
        }
    for (const glm::uvec2 hole : {glm::uvec2(10, 10), glm::uvec2(20, 5)}) {
        *inputs.depth.pixel(hole.x, hole.y) = 1;
        *inputs.mask.pixel(hole.x, hole.y) = 0;
    }
    const HostImage found = run({});
    // The gradient is that of 2x2 pixels: those which share them with a hole have another.
    const auto is_beside_hole = [](unsigned x, unsigned y) {
        return (x / 2 == 5 && y / 2 == 5) || (x / 2 == 10 && y / 2 == 2);
    };
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            if (!is_beside_hole(x, y)) {
                ASSERT_NEAR(found.pixel(x, y)[1], expected({x, y}, 0.9)[1], 1e-3) << x << ", " << y;
            }
}

TEST_F(DiligentCleanup, PassesThroughWhatItGetsWhenOff) {
    EXPECT_EQ(run({{"bilateral_cleanup", false}}).values, inputs.accumulated.radiance.values);
}

TEST_F(DiligentCleanup, FadesTheConfidence) {
    const HostImage whole = run({}), faded = run({{"alpha_interpolation", 0.25}});
    for (size_t i = 0; i < whole.values.size(); ++i)
        ASSERT_FLOAT_EQ(faded.values[i], i % 4 == 3 ? 0.25f * whole.values[i] : whole.values[i]);
}

/// With premultiply_confidence the stages before weight colours with their confidence. A grey of 0.4 of which a part is
/// missed stays grey beside the edge, where without the switch it is darkened once by the misses and once by the
/// composite.
TEST_F(DiligentCleanup, PremultipliedConfidenceIsDividedOut) {
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (unsigned c = 0; c < 4; ++c)
                inputs.accumulated.radiance.pixel(x, y)[c] = x < 16 ? 0.0f : c == 3 ? 1.0f : 0.4f;
    for (const bool bilateral_cleanup : {true, false}) {
        Overrides overrides = {{"bilateral_cleanup", bilateral_cleanup}};
        const HostImage as_original = run(overrides);
        overrides["premultiply_confidence"] = true;
        overrides["alpha_interpolation"] = 0.5;  // of the confidence after the division
        const HostImage found = run(overrides);
        EXPECT_NEAR(found.pixel(16, 5)[0], 0.4f, 1e-6f);
        EXPECT_EQ(found.pixel(2, 5)[0], 0.0f);
        const float confidence = as_original.pixel(16, 5)[3];
        EXPECT_FLOAT_EQ(found.pixel(16, 5)[3], 0.5f * confidence);
        EXPECT_FLOAT_EQ(as_original.pixel(16, 5)[0], 0.4f * confidence);
        EXPECT_EQ(confidence < 1, bilateral_cleanup);
    }
}

TEST_F(DiligentCleanup, IsBlackWhereTheMaskLeavesOut) {
    AccumulationBench bench(device(), extent, {{"roughness_threshold", threshold}});
    EXPECT_GT(bench.clean_up(inputs).pixel(9, 9)[0], 0.0f);
    *inputs.mask.pixel(9, 9) = 0;
    const HostImage found = bench.clean_up(inputs);
    EXPECT_EQ(found.pixel(9, 9)[0], 0.0f);
    EXPECT_EQ(found.pixel(9, 9)[3], 0.0f);
}

}  // namespace
