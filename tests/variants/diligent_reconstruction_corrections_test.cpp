#include "tests/variants/denoiser_tolerance.h"
#include "tests/variants/reconstruction_bench.h"
#include "tests/variants/technique_fixture.h"

#include <algorithm>
#include <limits>

// What each correction of spatial reconstruction fixes, and how its years differ, with the switch off and on.

namespace {

struct DiligentReconstructionCorrections : TechniqueTest {
    static Reconstruction run(const ReconstructionInputs& inputs, const nlohmann::json& overrides) {
        return ReconstructionBench(device(), inputs.depth.extent, overrides).run(inputs);
    }
};

/// Rays and results in 32 bits, so that formulas hold to float rounding.
nlohmann::json precisely(nlohmann::json overrides) {
    overrides["float_rays"] = overrides["float_histories"] = true;
    return overrides;
}

constexpr float float_error = 1e-5f;  // of sums of nine numbers up to 1, and quotients of them

/// Distances of the disk's points from its centre.
constexpr double disk_radii[] = {0.3149309, 0.5335386, 0.6461146, 0.6520134,
                                 0.6695386, 0.8346850, 0.8895339, 0.9542373};

TexelRay numbered_by_column(unsigned x, unsigned) { return {.radiance = glm::vec3(float(x))}; }

/// Of a pixel's sample of a perspective ReflectingWall of 32x32 pixels: 60 degrees high, tan^2 30 is a third.
double distance_over_depth(glm::uvec2 pixel, glm::vec2 jitter = {}) {
    const glm::dvec2 ndc = (glm::dvec2(pixel) + 0.5 + glm::dvec2(jitter)) / 16.0 - 1.0;
    return std::sqrt(1 + glm::dot(ndc, ndc) / 3);
}

double mean_variance(const Reconstruction& found) {
    double sum = 0;
    const unsigned border = 8;  // where rays are clamped to the image
    unsigned count = 0;
    for (unsigned y = border; y < found.variance.extent.y - border; ++y)
        for (unsigned x = border; x < found.variance.extent.x - border; ++x, ++count)
            sum += *found.variance.pixel(x, y);
    return sum / count;
}

}  // namespace

/// One white ray among black ones: the disk of four pixels has no point nearer than 1.26 pixels.
TEST_F(DiligentReconstructionCorrections, OwnRay) {
    const glm::uvec2 center{16, 16};
    double others = 0;
    for (const double radius : disk_radii) others += std::exp(-radius * radius / (2 * 0.81));
    for (const bool is_half : {false, true}) {
        const glm::uvec2 ray_extent = is_half ? glm::uvec2(16) : glm::uvec2(32);
        const ReconstructionInputs inputs = reflecting_wall(
            {.ray_extent = ray_extent, .ray = [&](unsigned x, unsigned y) {
                 return TexelRay{.radiance = glm::vec3(glm::uvec2(x, y) == center * ray_extent / 32u ? 1.0f : 0.0f)};
             }});
        // Twice the radius, so that at half resolution, too, no point of the disk is the pixel's own ray.
        for (const bool is_on : {false, true})
            EXPECT_NEAR(run(inputs, precisely({{"own_ray", is_on},
                                               {"half_resolution", is_half},
                                               {"spatial_reconstruction_radius", is_half ? 8 : 4}}))
                            .radiance.pixel(center.x, center.y)[0],
                        is_on ? 1 / (1 + others) : 0, float_error)
                << is_half;
    }
}

/// How far rays are spread over their own image, as the variance of their columns: as far as at full resolution, or
/// half.
TEST_F(DiligentReconstructionCorrections, ScaleRadius) {
    const auto spread = [](bool is_half, bool is_on) {
        const glm::uvec2 extent{96, 96}, ray_extent = is_half ? extent / 2u : extent;
        return mean_variance(run(
            reflecting_wall({.extent = extent, .ray_extent = ray_extent, .ray = numbered_by_column}),
            precisely({{"half_resolution", is_half}, {"scale_radius", is_on}, {"spatial_reconstruction_radius", 8}})));
    };
    const double full = spread(false, false);
    EXPECT_NEAR(spread(true, true) / full, 1, 0.05);  // texels round another way
    // Rounding to texels adds up to 1 / 12 to both, of about 10 and 2.5.
    EXPECT_NEAR(spread(true, false) / full, 0.25, 0.02);
}

/// The mirrored point lies on the view ray, 3 m behind a wall 4 m away: nearer to the camera plane than to the camera.
TEST_F(DiligentReconstructionCorrections, AxialHitDepth) {
    for (const glm::vec2 jitter : {glm::vec2(0), glm::vec2(0.4f, -0.3f)}) {
        const ReconstructionInputs inputs =
            reflecting_wall({.is_orthographic = false, .jitter = jitter, .ray = [](unsigned, unsigned) {
                                 return TexelRay{.direction = {0, 0, 3}};
                             }});
        for (const bool is_on : {false, true}) {
            const Reconstruction found =
                run(inputs, precisely({{"axial_hit_depth", is_on}, {"linear_hit_depth", true}}));
            for (const glm::uvec2 pixel : {glm::uvec2(16, 16), glm::uvec2(0, 0), glm::uvec2(31, 7)}) {
                const double secant = distance_over_depth(pixel, jitter);
                const double expected = is_on ? 4 + 3 / secant : 4 * secant + 3;
                EXPECT_NEAR(*found.hit_depth.pixel(pixel.x, pixel.y), expected, 1e-4) << pixel.x << ", " << jitter.x;
            }
        }
    }
}

/// Points around 21 m away: by halves of their device depth, which are 2 m apart there, or in metres.
TEST_F(DiligentReconstructionCorrections, LinearHitDepth) {
    const auto length = [](unsigned x) { return 2 + float(x) / 16; };
    const ReconstructionInputs inputs =
        reflecting_wall({.is_orthographic = false, .distance = 18, .roughness = 0, .ray = [&](unsigned x, unsigned) {
                             return TexelRay{.direction = {0, 0, length(x)}};
                         }});
    double greatest_error[2] = {};
    for (const bool is_on : {false, true}) {
        const Reconstruction found = run(inputs, precisely({{"axial_hit_depth", true}, {"linear_hit_depth", is_on}}));
        for (unsigned x = 0; x < 32; ++x) {
            const float depth = *found.hit_depth.pixel(x, 16),
                        expected = float(18 + length(x) / distance_over_depth({x, 16}));
            const glm::vec4 clip = inputs.camera.clip_from_view * glm::vec4(0, 0, -expected, 1);
            EXPECT_TRUE(is_on || std::abs(depth - clip.z / clip.w) <= one_half(depth)) << x;
            const double distance = is_on ? depth : view_distance(inputs.camera, depth);
            greatest_error[is_on] = std::max(greatest_error[is_on], std::abs(distance - expected));
        }
    }
    EXPECT_GT(greatest_error[0], 1.0);
    EXPECT_LT(greatest_error[1], 1e-3);  // device depth in 32 bits, from which the wall's own distance comes
}

/// Every other ray is bright, and its direction not a number: without the correction it has at least the least weight,
/// or is none itself.
TEST_F(DiligentReconstructionCorrections, FiniteWeights) {
    const float none = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    for (const glm::vec3 direction : {glm::vec3(none), glm::vec3(infinite, 0, 1)}) {
        const ReconstructionInputs inputs = reflecting_wall({.ray = [&](unsigned x, unsigned) {
            return x % 2 == 0 ? TexelRay{.radiance = glm::vec3(1e4f), .direction = direction} : TexelRay{};
        }});
        const auto off_by = [&](bool is_on) {
            const Reconstruction found = run(inputs, precisely({{"finite_weights", is_on}}));
            return std::abs(found.radiance.pixel(16, 16)[0] - 0.5f);
        };
        EXPECT_FALSE(off_by(false) < 1e-3f);
        EXPECT_LT(off_by(true), float_error);
    }
}

/// Pixels none of whose rays is a number are black, and so is their variance.
TEST_F(DiligentReconstructionCorrections, FiniteWeightsWithoutAnyRay) {
    const glm::vec3 none(std::numeric_limits<float>::quiet_NaN());
    const Reconstruction found =
        run(reflecting_wall({.ray = [&](unsigned, unsigned) { return TexelRay{.direction = none}; }}),
            precisely({{"finite_weights", true}, {"own_ray", true}}));
    for (const float value : found.radiance.values) EXPECT_EQ(value, 0.0f);
    for (const float value : found.variance.values) EXPECT_EQ(value, 0.0f);
}

/// Bright rays of no length: without the guard their direction is no number, and finite_weights leaves them out; with
/// it they have the least weight.
TEST_F(DiligentReconstructionCorrections, ShortRayGuard) {
    const ReconstructionInputs inputs = reflecting_wall({.ray = [](unsigned x, unsigned) {
        return x % 2 == 0 ? TexelRay{.radiance = glm::vec3(1e4f), .direction = glm::vec3(0)} : TexelRay{};
    }});
    for (const bool is_on : {false, true}) {
        const Reconstruction found = run(inputs, precisely({{"finite_weights", true}, {"short_ray_guard", is_on}}));
        EXPECT_EQ(std::abs(found.radiance.pixel(16, 16)[0] - 0.5f) < float_error, !is_on);
    }
}

/// What the mask leaves out shows the frame before, or nothing.
TEST_F(DiligentReconstructionCorrections, ClearTargets) {
    for (const bool is_on : {false, true}) {
        ReconstructionInputs inputs = reflecting_wall({.ray = numbered_by_column});
        ReconstructionBench bench(device(), inputs.depth.extent, precisely({{"clear_targets", is_on}}));
        const Reconstruction before = bench.run(inputs);
        inputs.mask = HostImage(inputs.mask.extent, 1, 0.0f);
        const Reconstruction after = bench.run(inputs);
        for (const auto& image : {&Reconstruction::radiance, &Reconstruction::variance, &Reconstruction::hit_depth}) {
            const HostImage black((before.*image).extent, (before.*image).channels);
            EXPECT_EQ((after.*image).values, (is_on ? black : before.*image).values);
        }
    }
}

/// A colour that is no half.
TEST_F(DiligentReconstructionCorrections, FloatHistories) {
    const ReconstructionInputs inputs =
        reflecting_wall({.ray = [](unsigned, unsigned) { return TexelRay{.radiance = glm::vec3(0.3f)}; }});
    for (const bool is_on : {false, true}) {
        const Reconstruction found = run(inputs, {{"float_rays", true}, {"float_histories", is_on}});
        const float error = std::abs(found.radiance.pixel(16, 16)[0] - 0.3f);
        if (is_on) {
            EXPECT_LT(error, 1e-6f);
        } else {
            EXPECT_GT(error, 4e-5f);  // the nearest half is 4.9e-5 away
        }
    }
}

/// Over 4x4 pixels the disk stands in 16 directions, each once in every frame; a frame later every pixel has the next.
TEST_F(DiligentReconstructionCorrections, RotateKernel) {
    const auto offsets = [&](unsigned frame, bool is_on) {
        ReconstructionInputs inputs = reflecting_wall({.ray = numbered_by_column});
        inputs.camera.frame.x = frame;
        const Reconstruction found = run(inputs, precisely({{"rotate_kernel", is_on}}));
        std::vector<float> values;
        for (unsigned y = 12; y < 16; ++y)
            for (unsigned x = 12; x < 16; ++x) values.push_back(found.radiance.pixel(x, y)[0] - float(x));
        return values;
    };
    const auto greatest_difference = [](const std::vector<float>& a, const std::vector<float>& b) {
        float greatest = 0;
        for (size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
        return greatest;
    };
    // Sixteenths of a turn in the first frame, by columns of pixels; here line by line.
    const int turns_of_pixel[16] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const std::vector<float> at_first = offsets(0, true);
    std::vector<float> of_turns(16);
    for (size_t i = 0; i < 16; ++i) of_turns[size_t(turns_of_pixel[i])] = at_first[i];
    EXPECT_GT(greatest_difference(offsets(5, true), at_first), 0.1f);
    EXPECT_EQ(offsets(5, false), at_first);
    for (const unsigned frame : {1u, 5u, 13u, 21u}) {
        std::vector<float> expected(16);
        for (size_t i = 0; i < 16; ++i) expected[i] = of_turns[(size_t(turns_of_pixel[i]) + frame) % 16];
        EXPECT_LT(greatest_difference(offsets(frame, true), expected), 20 * float_error) << frame;  // columns up to 20
    }
}

/// A lobe of alpha 0.0025, and half vectors 0.003 beside its centre: the floor makes both alike, without it they weigh
/// (1 + (0.003 / 0.0025)^2)^-2 of those in the centre.
TEST_F(DiligentReconstructionCorrections, DistributionFloor) {
    const float half_angle = 0.003f, alpha = 0.0025f;
    const glm::vec3 beside(std::sin(2 * half_angle), 0, std::cos(2 * half_angle));
    const auto share_of_left = [&](const glm::vec3& right, bool is_on) {
        const ReconstructionInputs inputs =
            reflecting_wall({.roughness = std::sqrt(alpha), .ray = [&](unsigned x, unsigned) {
                                 return x < 16 ? TexelRay{.radiance = glm::vec3(1)}
                                               : TexelRay{.radiance = glm::vec3(0), .direction = right};
                             }});
        const nlohmann::json overrides =
            precisely({{"distribution_floor", is_on}, {"spatial_reconstruction_radius", 32}});
        return run(inputs, overrides).radiance.pixel(16, 16)[0];
    };
    for (const bool is_on : {false, true}) {
        const double equal = share_of_left({0, 0, 1}, is_on), found = share_of_left(beside, is_on);
        const double weight = is_on ? 1 : std::pow(1 + std::pow(half_angle / alpha, 2), -2);
        // The cosine of 0.003 is rounded by up to 6e-8 of 4.5e-6: 3 % of the weight.
        EXPECT_NEAR((1 / found - 1) / (1 / equal - 1), weight, 0.03 * weight);
    }
}
