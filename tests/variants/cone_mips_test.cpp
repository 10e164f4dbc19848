// Mips of the picture of reflections: how wide each is, which one a cone chooses, and what averages leave of colours.
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"
#include "tests/variants/technique_passes.h"

#include <cmath>
#include <random>

namespace {

using Pixels = std::function<glm::vec4(glm::uvec2 pixel)>;  ///< what its rays see: radiance, confidence

/// Seen from an orthographic camera, unless a test says otherwise, one pixel per metre. Rays are mirrored across the
/// screen, at equal depth, to the farther side of it.
struct ConeMips : TechniqueTest {
    ParameterSet params;
    ParameterView half_resolution{params, "half_resolution"};

    glm::uvec2 extent{64, 64};
    float roughness = 0.3f, ray_length = 0;  ///< m, of all pixels
    glm::vec3 axis{1, 0, 0};                 ///< along which rays are mirrored; 0: back to the camera
    bool is_orthographic = true;
    float slope = 0;   ///< m that the surface is nearer from pixel to pixel to the right
    HostImage levels;  ///< which each traced pixel chose

    ConeMips() {
        add_denoiser(params, "cone_mips");
        params.assign({{"half_resolution", false}, {"max_roughness", 1.0}, {"fade_begin", 1.0}});
    }

    SyntheticHit surface(const CameraRay& ray) const {
        const glm::vec3 towards = dot(ray.origin, axis) < 0 ? axis : -axis;
        return {.distance = 10 - slope * ray.origin.x,
                .normal = normalize(towards + glm::vec3(0, 0, 1)),
                .roughness = roughness,
                .metalness = 1,
                .specular = 1};
    }

    /// Channels: radiance, confidence.
    HostImage show(const Pixels& seen) {
        PassList pass_list(device(), extent);
        return show(pass_list, seen);
    }
    HostImage show(PassList& pass_list, const Pixels& seen) {
        const CameraPose pose{
            .is_orthographic = is_orthographic, .orthographic_height = float(extent.y), .near = 1, .far = 20};
        const CameraData camera = camera_data(pose, nullptr, {.extent = extent});
        const GBuffer gbuffer =
            upload_gbuffer(pass_list, pose, camera, [&](const CameraRay& ray) { return surface(ray); });
        HostImage radiance(extent, 4);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x)
                for (int i = 0; i < 4; ++i) radiance.pixel(x, y)[i] = seen({x, y})[i];
        const Image own_radiance = pass_list.image("own_radiance", Format::rgba32f),
                    own_length = pass_list.image("own_length", Format::r32f);
        pass_list.upload(own_radiance, radiance);
        pass_list.upload(own_length, HostImage(extent, 1, ray_length));
        pass_list.begin_frame(camera, params, gbuffer.images());
        const HostImage shown =
            pass_list.download(denoiser_passes("cone_mips", pass_list, gbuffer,
                                               {{"own_radiance", own_radiance}, {"own_length", own_length}})
                                   .radiance);
        levels = pass_list.download(
            pass_list.image_of("cone_level", Format::r32f, half_resolution ? (extent + 1u) / 2u : extent));
        return shown;
    }

    static nlohmann::json all_corrections() {
        nlohmann::json corrections;
        for (const char* name : {"square_lengths", "lobe_cone", "even_weights", "tone_map_colors", "exact_upsampling"})
            corrections[name] = true;
        return corrections;
    }

    Pixels impulse() const {
        return [middle = extent / 2u](glm::uvec2 pixel) { return glm::vec4(glm::vec3(pixel == middle), 1); };
    }

    /// Mean square distance of the light from the pixel that it comes from: per axis, in pixels of level 0, each of
    /// which has `size` in the image.
    glm::dvec2 spread(const HostImage& image, double size) const {
        glm::dvec2 sum(0);
        double mass = 0;
        for (unsigned y = 0; y < image.extent.y; ++y)
            for (unsigned x = 0; x < image.extent.x; ++x) {
                const glm::dvec2 offset = (glm::dvec2(x, y) + 0.5) * size - (glm::dvec2(extent / 2u) + 0.5);
                const double light = *image.pixel(x, y);
                sum += light * offset * offset;
                mass += light;
            }
        return sum / mass;
    }
};

/// Of level m: 3.7038 (4^m - 1), as each level adds the mean of two texels of the one before (1/4) and seven weights of
/// variance 2.7153.
double variance_of_level(double level) { return 3.7038 * (std::exp2(2 * level) - 1); }

/// Of what pixels show of it, which lie between its texels: reading at a share t of the way to the next one adds t (1 -
/// t), of which the mean over the pixels' places is 1/6 + 1/12 * 4^-m.
double variance_shown(unsigned level) {
    return level == 0 ? 0 : variance_of_level(level) + std::exp2(2.0 * level) / 6 + 1.0 / 12;
}

double variance_between(double level) {
    const unsigned below = unsigned(level);
    return glm::mix(variance_shown(below), variance_shown(below + 1), level - below);
}

TEST_F(ConeMips, EachLevelIsAsWideAsItsFormula) {
    extent = {256, 256};
    params.assign({{"average_linear", true}});
    PassList pass_list(device(), extent);
    show(pass_list, impulse());
    const Image chain = pass_list.image_of("reflection_mips", Format::rgba32f, extent, 9);
    for (unsigned level = 1; level <= 4; ++level) {
        const glm::dvec2 found = spread(pass_list.download(chain.mip(level)), std::exp2(level));
        // The pixel lies in the corner of its texel of each level, and not anywhere in it as the formula's do.
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(found[i] / variance_of_level(level), 1, 0.02) << level;
    }
}

/// Roughness, length of the ray on the screen over its width, and level, by Godot's formula at 1920 pixels of width.
TEST_F(ConeMips, ConeOfRoughnessAndLengthChoosesTheWidth) {
    extent = {256, 256};
    params.assign({{"average_linear", true}, {"level_radius", 16.0 * 256 / 1920}});
    const glm::dvec3 cases[] = {
        {0.3, 0.05, 1.523}, {0.3, 0.2, 3.086}, {0.3, 0.5, 4.062}, {0.1, 0.2, 2.086}, {0.5, 0.2, 3.452}};
    for (const glm::dvec3& c : cases) {
        roughness = float(c[0]);
        ray_length = 256 * float(c[1]);
        const glm::dvec2 found = spread(show(impulse()), 1);
        EXPECT_NEAR(*levels.pixel(0, 0), c[2], 2e-3);
        // As above, and the widest reaches the border.
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(found[i] / variance_between(c[2]), 1, 0.04) << c[0] << ", " << c[1];
    }
}

/// Shorter side and longer side: 32 m are as far in both directions.
TEST_F(ConeMips, LengthsAreSharesOfEachSideOrPixels) {
    extent = {256, 128};
    ray_length = 32;
    const auto level_along = [&](glm::vec3 direction, bool in_pixels) {
        axis = direction;
        params.assign({{"square_lengths", in_pixels}});
        show(impulse());
        return *levels.pixel(128, 64);
    };
    // R = 0.3122 of the length: log2(1 + R * 256 / 16).
    const glm::vec3 right(1, 0, 0), up(0, 1, 0);
    const double across = std::log2(1 + 0.3122 * 32 / 256 * 16), twice = std::log2(1 + 0.3122 * 32 / 128 * 16);
    EXPECT_NEAR(level_along(right, false), across, 1e-3);
    EXPECT_NEAR(level_along(right, true), across, 1e-3);
    EXPECT_NEAR(level_along(up, true), across, 1e-3);
    EXPECT_NEAR(level_along(up, false), twice, 1e-3);
}

/// Rays without a hit are as long as the way to the border.
TEST_F(ConeMips, MissesReachTheBorder) {
    extent = {64, 16};
    show(impulse());
    for (const unsigned x : {0u, 20u, 31u}) {
        const double length = (64 - (x + 0.5)) / 64;
        EXPECT_NEAR(*levels.pixel(x, 8),
                    std::log2(1 + 0.3122 * length * 64 / 16) * std::pow(std::min(1.25 - length, 1.0), 0.2), 1e-3);
    }
}

/// Half of what is mirrored by micro-normals of tan^2 = alpha^2 u / (1 - u) (Walter et al. 2007, eq. 35), u in [0, 1),
/// lies within twice the angle whose tangent is alpha, and half of a Gaussian within 1.1774 of its standard deviations.
TEST_F(ConeMips, LobeConeIsAsWideAsTheLobe) {
    extent = {256, 256};
    axis = glm::vec3(0);
    params.assign({{"average_linear", true}, {"lobe_cone", true}});
    for (const glm::dvec2& c : {glm::dvec2(0.3, 20), glm::dvec2(0.3, 100), glm::dvec2(0.5, 40)}) {
        roughness = float(c[0]);
        ray_length = float(c[1]);
        const double deviation = std::tan(2 * std::atan(c[0] * c[0])) * c[1] / 1.1774;
        const glm::dvec2 found = spread(show(impulse()), 1);
        // Reading between texels adds a sixth of their area, which is up to deviation^2 / 3.7, and a twelfth.
        for (int i = 0; i < 2; ++i) {
            EXPECT_GT(found[i], 0.97 * deviation * deviation);
            EXPECT_LT(found[i], 1.07 * deviation * deviation + 1);
        }
    }
}

TEST_F(ConeMips, MirrorsShowTheirOwnRays) {
    extent = {37, 23};
    roughness = 0;
    std::mt19937 random(1);
    std::exponential_distribution<float> exponential(0.1f);
    std::uniform_real_distribution<float> uniform(0, 1);
    HostImage drawn(extent, 4);
    for (size_t i = 0; i < drawn.pixel_count(); ++i) {
        drawn.set_rgb(i, {exponential(random), exponential(random), 1e6f * exponential(random)});
        drawn.values[4 * i + 3] = uniform(random);
    }
    const HostImage shown = show([&](glm::uvec2 pixel) {
        const float* v = drawn.pixel(pixel.x, pixel.y);
        return glm::vec4(v[0], v[1], v[2], v[3]);
    });
    EXPECT_EQ(shown.values, drawn.values);
}

/// Of any size, with the corrections and without, up to the border.
TEST_F(ConeMips, ConstantPicturesStayConstant) {
    const glm::vec4 color(3, 0.5f, 20, 0.75f);
    for (const nlohmann::json& corrections :
         {nlohmann::json::object(), all_corrections(), nlohmann::json{{"average_linear", true}}})
        for (const bool half_resolution : {false, true})
            for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(1, 9), glm::uvec2(67, 41)}) {
                extent = size;
                params.assign(corrections);
                params.assign({{"half_resolution", half_resolution}});
                const HostImage shown = show([&](glm::uvec2) { return color; });
                for (size_t i = 0; i < shown.values.size(); ++i)
                    ASSERT_NEAR(shown.values[i], color[int(i % 4)], 1e-4f * color[int(i % 4)])
                        << corrections << size.x << " x " << size.y << ", half: " << half_resolution;
            }
}

/// Luminances up to those that the tone map rounds to 1, with rays to all sides, also to the camera and past it.
TEST_F(ConeMips, StaysFiniteAndInRange) {
    extent = {33, 17};
    roughness = 0.45f;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (const nlohmann::json& corrections :
         {nlohmann::json::object(), all_corrections(), nlohmann::json{{"average_linear", true}}})
        for (const bool half_resolution : {false, true})
            for (const bool orthographic : {false, true})
                for (const glm::vec3 direction : {glm::vec3(0), glm::vec3(0.5f, 1, 0), glm::vec3(1, 0, 0)}) {
                    is_orthographic = orthographic;
                    axis = direction;
                    params.assign(corrections);
                    params.assign({{"half_resolution", half_resolution}});
                    const HostImage shown = show([&](glm::uvec2) {
                        const float confidence = uniform(random) < 0.3f ? 0 : uniform(random);
                        return glm::vec4(glm::vec3(uniform(random), uniform(random), uniform(random)) *
                                             std::pow(10.0f, 12 * uniform(random)),
                                         confidence);
                    });
                    for (const float value : shown.values) ASSERT_TRUE(std::isfinite(value) && value >= 0) << value;
                    for (size_t i = 3; i < shown.values.size(); i += 4) ASSERT_LE(shown.values[i], 1);
                }
}

/// Every other column is lit. Level 1 and those above see the mean of both.
struct ConeMipsColumns : ConeMips {
    glm::vec4 mean_of(glm::vec4 even, glm::vec4 odd, const nlohmann::json& parameters) {
        extent = {128, 64};
        ray_length = 24;
        params.assign({{"level_radius", 4}});
        params.assign(parameters);
        const HostImage shown = show([&](glm::uvec2 pixel) { return pixel.x % 2 == 0 ? even : odd; });
        EXPECT_NEAR(*levels.pixel(40, 32), 1.5, 0.1);
        const float* found = shown.pixel(40, 32);
        return {found[0], found[1], found[2], found[3]};
    }
};

/// The mean of b and 0 becomes m / (1 - m) of m = b / (2 (1 + b)).
TEST_F(ConeMipsColumns, ToneMapDarkensHighlights) {
    const glm::vec4 dark(0, 0, 0, 1);
    for (const auto& [b, expected] :
         {std::pair(1.0f, 0.3333f), std::pair(10.0f, 0.8333f), std::pair(100.0f, 0.9804f)}) {
        const glm::vec4 bright(b, b, b, 1);
        EXPECT_NEAR(mean_of(bright, dark, {{"average_linear", false}}).r, expected, 1e-4f);
        EXPECT_NEAR(mean_of(bright, dark, {{"average_linear", true}}).r, b / 2, 1e-5f * b);
    }
}

/// Half of what is seen is known, and has luminance l. Times confidence the original shows l / 2 / (1 + l / 2), darker.
TEST_F(ConeMipsColumns, ToneMapOfColorTimesConfidenceDarkensBorders) {
    const glm::vec4 known(10, 10, 10, 1);
    const nlohmann::json even = {{"even_weights", true}, {"tone_map_colors", false}};
    // t / (1 - t) of t = 10 / 11 / 2.
    const glm::vec4 original = mean_of(known, glm::vec4(0), even);
    EXPECT_NEAR(original.a, 0.5f, 1e-5f);
    EXPECT_NEAR(original.r * original.a, 0.8333f, 1e-4f);
    const glm::vec4 corrected = mean_of(known, glm::vec4(0), {{"tone_map_colors", true}});
    EXPECT_NEAR(corrected.a, 0.5f, 1e-5f);
    EXPECT_NEAR(corrected.r, 10, 1e-3f);
}

/// Beside the border between what is known and what is not, of level 1, a Gaussian has 0.6073 of its mass on the
/// pixel's own side; neighbours without confidence weigh 0.2.
TEST_F(ConeMips, ConfidenceGrowsIntoMissesOrIsAMean) {
    extent = {64, 16};
    const auto border = [](glm::uvec2 pixel) { return glm::vec4(pixel.x < 32 ? 1.0f : 0.0f); };
    for (const bool even_weights : {false, true}) {
        params.assign({{"even_weights", even_weights}});
        PassList pass_list(device(), extent);
        show(pass_list, border);
        const HostImage level =
            pass_list.download(pass_list.image_of("reflection_mips", Format::rgba32f, extent, 5).mip(1));
        EXPECT_NEAR(level.pixel(15, 4)[3], even_weights ? 0.6073f : 0.8855f, 1e-4f);
        EXPECT_NEAR(level.pixel(16, 4)[3], even_weights ? 0.3927f : 0.7638f, 1e-4f);
        EXPECT_NEAR(level.pixel(4, 4)[3], 1, 1e-6f);
        EXPECT_EQ(level.pixel(26, 4)[3], 0);
    }
}

/// Each pair of columns shows its number, between them their mix.
TEST_F(ConeMips, UpsamplingIsBilinear) {
    extent = {15, 9};
    axis = glm::vec3(0);
    roughness = 0;
    params.assign({{"half_resolution", true}, {"exact_upsampling", true}});
    const auto pairs = [](glm::uvec2 pixel) { return glm::vec4(glm::vec3(float(pixel.x / 2)), 1); };
    const HostImage shown = show(pairs);
    for (unsigned x = 0; x < extent.x; ++x)
        EXPECT_NEAR(*shown.pixel(x, 4), std::clamp((float(x) + 0.5f) / 2 - 0.5f, 0.0f, 7.0f), 1e-3f);
    params.assign({{"exact_upsampling", false}});
    // The first column is taken for one between the first and the second pair.
    EXPECT_NEAR(*show(pairs).pixel(0, 4), 0.75f, 0.1f);
}

/// Where depths differ by more than 0.05 from pixel to pixel no weight of exp(-2048 * 0.05) is a normal float.
TEST_F(ConeMips, UpsamplingOfSlopesIsNotBlack) {
    extent = {16, 9};
    axis = glm::vec3(0);
    slope = 1.1f;
    const auto grey = [](glm::uvec2) { return glm::vec4(1); };
    params.assign({{"half_resolution", true}, {"exact_upsampling", false}});
    EXPECT_EQ(*show(grey).pixel(7, 4), 0);
    params.assign({{"exact_upsampling", true}});
    EXPECT_NEAR(*show(grey).pixel(7, 4), 1, 1e-4f);
}

}  // namespace
