#include "tests/groundtruth/ggx_densities.h"
#include "tests/variants/reconstruction_bench.h"
#include "tests/variants/technique_fixture.h"

#include <random>

// What spatial reconstruction makes of rays, by formulas; diligent_reconstruction_golden_test.cpp holds it to the
// original's own results, diligent_reconstruction_corrections_test.cpp to what its corrections promise.

namespace {

struct DiligentReconstruction : TechniqueTest {
    /// Rays and results in 32 bits, so that formulas hold to float rounding; depths along the axis in metres.
    static Reconstruction run(const ReconstructionInputs& inputs, nlohmann::json overrides = {}) {
        overrides["float_rays"] = overrides["float_histories"] = overrides["linear_hit_depth"] = true;
        overrides["axial_hit_depth"] = true;
        ReconstructionBench bench(device(), inputs.depth.extent, overrides);
        return bench.run(inputs);
    }
};

TexelRay white_or_black(unsigned x, unsigned y) {
    const float white = (x * 7 + y * 3) % 5 < 2 ? 1.0f : 0.0f;
    return {.radiance = glm::vec3(white), .confidence = white};
}

constexpr float float_error = 1e-5f;  // of sums of nine numbers up to 1, and quotients of them

/// Integrates a function of the direction times the lobe and its cosine over the hemisphere (midpoint rule in the
/// projected disk, whose 4e-6 sr cells the lobe of alpha 0.16 is smooth in), over the same without the function.
template <class F>
double lobe_average(glm::vec3 to_camera, float alpha, F&& f) {
    const int n = 1024;
    double sum = 0, weight = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double x = (2.0 * i + 1) / n - 1, y = (2.0 * j + 1) / n - 1, r2 = x * x + y * y;
            if (r2 >= 1) continue;
            const glm::vec3 direction(x, y, std::sqrt(1 - r2));
            const double w = ggx_specular(to_camera, direction, alpha);  // the cosine is the disk's Jacobian
            sum += w * f(direction);
            weight += w;
        }
    return sum / weight;
}

}  // namespace

TEST_F(DiligentReconstruction, KeepsWhatAllRaysShare) {
    const Reconstruction found = run(reflecting_wall({.is_orthographic = false}));
    for (size_t i = 0; i < found.variance.pixel_count(); ++i) {
        EXPECT_NEAR(found.radiance.values[4 * i], 0.5f, float_error);
        EXPECT_NEAR(found.radiance.values[4 * i + 3], 1.0f, float_error);
        EXPECT_EQ(found.variance.values[i], 0.0f);
    }
}

/// Of values 0 and 1 with mean m, the variance is m (1 - m), whatever the weights.
TEST_F(DiligentReconstruction, HasTheVarianceOfItsOwnWeights) {
    const Reconstruction found = run(reflecting_wall({.is_orthographic = false, .ray = white_or_black}));
    double spread = 0;
    for (size_t i = 0; i < found.variance.pixel_count(); ++i) {
        const float mean = found.radiance.values[4 * i];
        EXPECT_NEAR(found.variance.values[i], mean * (1 - mean), float_error);
        spread = std::max(spread, double(found.variance.values[i]));
    }
    EXPECT_GT(spread, 0.2);
}

/// A wall that faces an orthographic camera has the same neighbours in both spaces but for the turn of its tangents.
/// One that is seen at a grazing angle has them on a narrow ellipse: across it, where rays change by columns, less
/// changes.
TEST_F(DiligentReconstruction, WorldSpaceFollowsTheSurface) {
    const auto columns = [](unsigned x, unsigned) { return TexelRay{.radiance = glm::vec3(float(x % 2))}; };
    const auto spread = [&](ReconstructionInputs inputs, const char* space, float slant) {
        for (size_t i = 0; i < inputs.normal.pixel_count(); ++i)
            inputs.normal.set_rgb(i, {std::sin(slant), 0, std::cos(slant)});
        const Reconstruction found = run(inputs, {{"reconstruction_space", space}});
        double sum = 0;
        for (const float variance : found.variance.values) sum += variance / double(found.variance.values.size());
        return sum;
    };
    const ReconstructionInputs wall = reflecting_wall({.ray = columns});
    EXPECT_NEAR(spread(wall, "world", 0), spread(wall, "screen", 0), 0.05);
    EXPECT_GT(spread(wall, "screen", 1.5f), 0.15);
    EXPECT_LT(spread(wall, "world", 1.5f), 0.02) << "0.07 of four pixels: the pixel's own column";
}

/// ceil(8 * 5 roughness) of the eight: a single ray has no variance, two of 0 and 1 have at most 1/4, and from a
/// roughness of 0.2 on nothing changes.
TEST_F(DiligentReconstruction, VariableSamplesAreAsManyAsTheDiskIsWide) {
    const auto of_roughness = [&](float roughness, bool is_variable) {
        return run(reflecting_wall({.is_orthographic = false, .roughness = roughness, .ray = white_or_black}),
                   {{"variable_samples", is_variable}, {"spatial_reconstruction_radius", 32}});
    };
    const Reconstruction one = of_roughness(0.024f, true), all = of_roughness(0.024f, false);
    double spread = 0;
    for (size_t i = 0; i < one.variance.pixel_count(); ++i) {
        const float value = one.radiance.values[4 * i];
        EXPECT_TRUE(value < float_error || value > 1 - float_error) << value;
        EXPECT_LT(one.variance.values[i], float_error);
        spread = std::max(spread, double(all.variance.values[i]));
    }
    EXPECT_GT(spread, 0.2);
    const Reconstruction two = of_roughness(0.04f, true);
    EXPECT_NE(two.radiance.values, of_roughness(0.04f, false).radiance.values);
    EXPECT_GT(std::ranges::max(two.variance.values), 0.1f) << "more than one";
    EXPECT_EQ(of_roughness(0.2f, true).radiance.values, of_roughness(0.2f, false).radiance.values);
    EXPECT_EQ(of_roughness(0.5f, true).variance.values, of_roughness(0.5f, false).variance.values);
}

/// A ray counts by one over its density, which densities below 1e-5 count as.
TEST_F(DiligentReconstruction, DividesByTheDensity) {
    const auto share_of_left = [](float left_density, float right_density) {
        return run(reflecting_wall({.ray =
                                        [&](unsigned x, unsigned) {
                                            const bool is_left = x < 16;
                                            return TexelRay{.radiance = glm::vec3(is_left ? 1.0f : 0.0f),
                                                            .density = is_left ? left_density : right_density};
                                        }}))
            .radiance.pixel(16, 16)[0];
    };
    struct Case {
        float left_density, right_density;
        double weight;  ///< of the right over the left
    };
    const double equal = share_of_left(1, 1);
    for (const auto [left, right, weight] :
         {Case{100, 20, 5}, Case{1e-3f, 4e-4f, 2.5}, Case{2e-5f, 1e-5f, 2}, Case{1e-5f, 1e-7f, 1}})
        EXPECT_NEAR((1 / share_of_left(left, right) - 1) / (1 / equal - 1), weight, 1e-4 * weight) << right;
}

/// A mirror's neighbours are the pixel itself.
TEST_F(DiligentReconstruction, LeavesMirrorsSharp) {
    const ReconstructionInputs inputs = reflecting_wall({.roughness = 0, .ray = white_or_black});
    const Reconstruction found = run(inputs);
    for (size_t i = 0; i < found.radiance.values.size(); ++i)
        EXPECT_NEAR(found.radiance.values[i], inputs.ray_radiance.values[i], float_error);
}

/// At half resolution, where even pixels have the ray of their 2x2, odd ones have, as in the original, that of the
/// next; corrected their own.
TEST_F(DiligentReconstruction, RoundsUpAtHalfResolutionUnlessCorrected) {
    const ReconstructionInputs inputs =
        reflecting_wall({.ray_extent = {16, 16}, .roughness = 0, .ray = [](unsigned x, unsigned y) {
                             return TexelRay{.radiance = glm::vec3(x, y, 0)};
                         }});
    for (const bool is_corrected : {false, true}) {
        const Reconstruction found = run(inputs, {{"half_resolution", true}, {"nearest_half_rays", is_corrected}});
        const auto ray_of = [&](unsigned x) { return float(is_corrected ? x / 2 : std::min((x + 1) / 2, 15u)); };
        for (unsigned y = 0; y < 32; ++y)
            for (unsigned x = 0; x < 32; ++x) {
                EXPECT_NEAR(found.radiance.pixel(x, y)[0], ray_of(x), 16 * float_error);
                EXPECT_NEAR(found.radiance.pixel(x, y)[1], ray_of(y), 16 * float_error);
            }
    }
}

/// The nearest point of the disk counts most, the farthest least, or the other way round.
TEST_F(DiligentReconstruction, WeighsByDistance) {
    const glm::uvec2 center{16, 16};
    const auto white_within_six_pixels = [&](unsigned x, unsigned y) {
        const glm::vec2 offset = glm::vec2(x, y) - glm::vec2(center);
        return TexelRay{.radiance = glm::vec3(glm::length(offset) < 6.0f ? 1.0f : 0.0f)};
    };
    const ReconstructionInputs inputs = reflecting_wall({.ray = white_within_six_pixels});
    // With a radius of 8 pixels, the points 0.31, 0.53, 0.65, 0.65 and 0.67 of it away are within 6, to half a pixel.
    const double radii[8] = {0.3149309, 0.5335386, 0.6461146, 0.6520134, 0.6695386, 0.8346850, 0.8895339, 0.9542373};
    for (const bool is_double : {false, true}) {
        double near = 0, all = 0;
        for (int i = 0; i < 8; ++i) {
            const double gaussian = std::exp(-radii[i] * radii[i] / (2 * 0.81));
            const double weight = is_double ? std::exp(-0.66 * gaussian * gaussian) : gaussian;
            all += weight;
            if (i < 5) near += weight;
        }
        const Reconstruction found = run(inputs, {{"spatial_kernel", is_double ? "double_gaussian" : "gaussian"},
                                                  {"spatial_reconstruction_radius", 8}});
        EXPECT_NEAR(found.radiance.pixel(center.x, center.y)[0], near / all, float_error) << is_double;
    }
}

/// Rays of all pixels drawn from the same lobe with its own density: on average the reconstruction is the lobe's mean,
/// here of a slope of light from one side to the other.
TEST_F(DiligentReconstruction, IsUnbiasedAmongEqualNeighbors) {
    const glm::vec3 to_camera(0, 0, 1);
    const float roughness = 0.4f, alpha = roughness * roughness;
    const auto light = [](glm::vec3 direction) { return 1.0f + direction.x + direction.z; };
    const glm::uvec2 extent{256, 256};
    std::mt19937 generator(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    const ReconstructionInputs inputs = reflecting_wall(
        {.extent = extent, .ray_extent = extent, .roughness = roughness, .ray = [&](unsigned, unsigned) {
             const glm::vec2 u(uniform(generator), uniform(generator));
             const glm::vec3 direction = sample_ggx_reflection(to_camera, alpha, u);
             const float density = ggx_reflection_pdf(to_camera, direction, alpha);
             return TexelRay{.radiance = glm::vec3(light(direction)), .direction = direction, .density = density};
         }});
    const Reconstruction found = run(inputs);
    double sum = 0;
    for (size_t i = 0; i < found.variance.pixel_count(); ++i) sum += found.radiance.values[4 * i];
    // Light's standard deviation over the lobe is 0.41: 0.0016 for the mean of 256^2 rays. 5 of these, one false alarm
    // in a million; and the bias of weights that eight rays normalise, 4e-4 here.
    EXPECT_NEAR(sum / double(found.variance.pixel_count()), lobe_average(to_camera, alpha, light), 5 * 0.0016 + 4e-4);
}

/// White hits before a white environment. The original's composite multiplies the share of rays that hit by itself:
/// down to 0.75 of white. With colours that were multiplied by the confidence, and are divided by it at the end, all is
/// white.
TEST_F(DiligentReconstruction, WeighsColorsAndConfidenceAlike) {
    const Reconstruction found = run(reflecting_wall({.ray = [](unsigned x, unsigned) {
        const float hit = x < 16 ? 1.0f : 0.0f;
        return TexelRay{.radiance = glm::vec3(hit), .confidence = hit};
    }}));
    double darkest = 1;
    for (size_t i = 0; i < found.variance.pixel_count(); ++i) {
        const double color = found.radiance.values[4 * i], confidence = found.radiance.values[4 * i + 3];
        EXPECT_EQ(color, confidence);
        darkest = std::min(darkest, 1 - confidence + confidence * color);
    }
    EXPECT_NEAR(darkest, 0.75, 0.003);  // shares of eight rays in 16 rotations come within 0.05 of a half
}

/// The farthest hit, but not of rays below the horizon, which count for nothing.
TEST_F(DiligentReconstruction, TakesTheLongestRay) {
    const Reconstruction found = run(reflecting_wall({.ray = [](unsigned x, unsigned y) {
        const float length = (x + y) % 4 != 1 ? 3.0f : 1.0f;
        return x % 4 == 0 ? TexelRay{.direction = {0, 0, -9}} : TexelRay{.direction = {0, 0, length}};
    }}));
    const unsigned border = 4;  // of rays clamped to the image, whose pattern is another
    for (unsigned y = border; y < 32 - border; ++y)
        for (unsigned x = border; x < 32 - border; ++x) EXPECT_NEAR(*found.hit_depth.pixel(x, y), 4 + 3, 1e-4f);
}

TEST_F(DiligentReconstruction, SwitchedOffIsThePixelsOwnRay) {
    const auto numbered = [](unsigned x, unsigned y) {
        return TexelRay{.radiance = glm::vec3(float(x), float(y), 1), .direction = {0, 0, 1 + x % 3}};
    };
    for (const bool is_half : {false, true}) {
        const glm::uvec2 extent{33, 31}, ray_extent = is_half ? extent / 2u : extent;
        const Reconstruction found = run(reflecting_wall({.extent = extent, .ray_extent = ray_extent, .ray = numbered}),
                                         {{"spatial_reconstruction", false}, {"half_resolution", is_half}});
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const glm::uvec2 own = glm::min(glm::uvec2(x, y) / (is_half ? 2u : 1u), ray_extent - 1u);
                EXPECT_EQ(found.radiance.pixel(x, y)[0], float(own.x));
                EXPECT_EQ(found.radiance.pixel(x, y)[1], float(own.y));
                EXPECT_EQ(*found.variance.pixel(x, y), 1.0f);
                EXPECT_NEAR(*found.hit_depth.pixel(x, y), 5 + float(own.x % 3), 1e-4f);
            }
    }
}
