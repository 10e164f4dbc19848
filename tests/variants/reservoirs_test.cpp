// Reservoirs: what one stands for after any number of frames, and what is shown of neighbours' ones.
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"
#include "tests/variants/technique_passes.h"
#include "variants/common/ggx_lobe.h"

#include <cmath>
#include <optional>
#include <random>

namespace {

/// What a pixel's ray sees; nothing: it has none.
struct SeenRay {
    glm::vec3 direction{0, 0, 1};  ///< unit, world space
    float length = 1000;           ///< m
    glm::vec3 radiance{1};         ///< times the share that is known
    float known = 1;
};
using Rays = std::function<std::optional<SeenRay>(glm::uvec2 pixel)>;

/// A wall that faces an orthographic camera, seen at ten pixels per metre.
struct ReservoirsTest : TechniqueTest {
    ParameterSet params;
    std::mt19937 random{1};

    glm::uvec2 extent{48, 32};
    float roughness = 0.1f, fallback = 0;
    bool is_orthographic = true;
    SyntheticScene scene = [this](const CameraRay& ray) {
        return SyntheticHit{.distance = 10 / -ray.direction.z,
                            .normal = {0, 0, 1},
                            .roughness = roughness,
                            .metalness = 1,
                            .specular = 1};
    };
    std::optional<PassList> pass_list;
    unsigned frame = 0;

    ReservoirsTest() {
        add_denoiser(params, "reservoirs");
        params.assign({{"half_resolution", false}, {"max_roughness", 1.0}, {"lobe", "visible_normals"}});
    }

    float uniform() { return float(random() >> 8) * 0x1p-24f; }

    /// The next frame. Channels: radiance, confidence.
    HostImage next(const Rays& rays) {
        if (!pass_list || pass_list->extent() != extent) pass_list.emplace(device(), extent);
        const CameraPose pose{
            .is_orthographic = is_orthographic, .orthographic_height = 0.1f * float(extent.y), .near = 1, .far = 1000};
        const CameraData camera =
            camera_data(pose, frame > 0 ? &pose : nullptr, {.extent = extent, .frame = frame, .seed = 3});
        const GBuffer gbuffer = upload_gbuffer(*pass_list, pose, camera, scene);
        HostImage radiance(extent, 4), direction(extent, 4);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x)
                if (const std::optional<SeenRay> ray = rays({x, y})) {
                    for (int i = 0; i < 3; ++i) {
                        radiance.pixel(x, y)[i] = ray->radiance[i];
                        direction.pixel(x, y)[i] = ray->direction[i] * ray->length;
                    }
                    radiance.pixel(x, y)[3] = ray->known;
                    direction.pixel(x, y)[3] = 1;
                }
        const Image ray_radiance = pass_list->image("ray_radiance", Format::rgba32f),
                    ray_direction = pass_list->image("ray_direction", Format::rgba32f);
        pass_list->upload(ray_radiance, radiance);
        pass_list->upload(ray_direction, direction);
        pass_list->upload(gbuffer.fallback, HostImage(extent, 4, fallback));
        pass_list->begin_frame(camera, params, gbuffer.images());
        ++frame;
        return pass_list->download(denoiser_passes("reservoirs", *pass_list, gbuffer,
                                                   {{"ray_radiance", ray_radiance}, {"ray_direction", ray_direction}})
                                       .radiance);
    }

    /// A direction of the wall's lobe above its horizon.
    glm::vec3 drawn() {
        for (;;) {
            const glm::vec3 direction =
                sample_lobe(lobe_of_visible_normals, {0, 0, 1}, ggx_alpha(roughness), 0, {uniform(), uniform()})
                    .direction;
            if (direction.z > 1e-3f) return direction;
        }
    }
};

double mean_of(const HostImage& shown, int channel = 0) {
    double sum = 0;
    for (size_t i = 0; i < shown.pixel_count(); ++i) sum += shown.values[4 * i + size_t(channel)];
    return sum / double(shown.pixel_count());
}

TEST_F(ReservoirsTest, AloneARayIsShownAsItIs) {
    roughness = 0.5f;
    fallback = 2;
    params.assign({{"spatial_reuse", false}});
    const auto seen = [](glm::uvec2 pixel) { return glm::vec3(pixel.x, pixel.y, 1); };
    const HostImage shown = next([&](glm::uvec2 pixel) -> std::optional<SeenRay> {
        if (pixel.x == 7) return std::nullopt;
        return SeenRay{.direction = drawn(), .radiance = 0.25f * seen(pixel), .known = 0.25f};
    });
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            EXPECT_EQ(shown.pixel(x, y)[3], x == 7 ? 0 : 1);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(shown.pixel(x, y)[i], x == 7 ? 0 : 0.25f * seen({x, y})[i] + 0.75f * 2, 1e-3f);
        }
}

/// Of rays of one density the kept one times its weight is the mean of all, whichever is kept; from the ninth frame on
/// it stands for eight at most, and the new one's share is a ninth.
TEST_F(ReservoirsTest, WeightsOverTimeAreMeans) {
    params.assign({{"spatial_reuse", false}});
    std::vector<double> expected(size_t(extent.x) * extent.y);
    HostImage shown;
    for (unsigned count = 0; count < 14; ++count) {
        shown = next([&](glm::uvec2 pixel) {
            const float seen = 0.1f + 3 * uniform();
            double& mean = expected[pixel.y * extent.x + pixel.x];
            mean += (seen - mean) / (1 + std::min(count, 8u));
            return SeenRay{.radiance = glm::vec3(seen)};
        });
        const HostImage kept = pass_list->download(pass_list->history("reservoir_origin", Format::rgba32f).current);
        EXPECT_FLOAT_EQ(kept.pixel(20, 20)[3], float(std::min(count + 1, 9u)));
    }
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(shown.values[4 * i], expected[i], 1e-4 * expected[i]);
}

/// Offsets of more than the square root of 0.05 of the distance.
TEST_F(ReservoirsTest, RaysFromFarAwayAreForgotten) {
    params.assign({{"spatial_reuse", false}});
    float distance = 10;
    scene = [&](const CameraRay&) {
        return SyntheticHit{
            .distance = distance, .normal = {0, 0, 1}, .roughness = 0.1f, .metalness = 1, .specular = 1};
    };
    const auto shown_at = [&](float second_distance, float ray_length) {
        frame = 0;
        distance = 10;
        next([&](glm::uvec2) { return SeenRay{.length = ray_length, .radiance = glm::vec3(5)}; });
        distance = second_distance;
        return *next([&](glm::uvec2) { return SeenRay{.length = ray_length}; }).pixel(20, 20);
    };
    EXPECT_NEAR(shown_at(11, 900), 3, 0.01f);
    EXPECT_NEAR(shown_at(14, 900), 1, 1e-4f);
    // The hit would be 1.25 times as far away: its density 1.6 times as low.
    EXPECT_NEAR(shown_at(11, 4), 1, 1e-4f);
}

/// In the mean over pixels, rays and what is kept of them show what the lobe sees above the horizon, also in colours
/// that are not those by which rays are kept.
TEST_F(ReservoirsTest, MeanOverPixelsIsTheLobes) {
    roughness = 0.5f;
    const auto sky = [](glm::vec3 direction) {
        const float red = 1 + 3 * direction.x * direction.x + direction.y;
        return glm::vec3(red, 1 / (red + 0.1f), 0);
    };
    glm::dvec3 expected(0);
    const int samples = 200'000;
    for (int i = 0; i < samples; ++i) expected += glm::dvec3(sky(drawn())) / double(samples);
    for (const bool spatial_reuse : {false, true}) {
        params.assign({{"spatial_reuse", spatial_reuse}});
        frame = 0;
        HostImage shown;
        for (int i = 0; i < 4; ++i)
            shown = next([&](glm::uvec2) {
                const glm::vec3 direction = drawn();
                return SeenRay{.direction = direction, .length = 900, .radiance = sky(direction)};
            });
        // Means of 1536 pixels scatter by 1 %.
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(mean_of(shown, i) / expected[i], 1, 0.04) << spatial_reuse;
    }
}

/// Smooth surfaces take nothing from rough ones, whose rays are not theirs, nor from those that face another way.
TEST_F(ReservoirsTest, NeighboursOfOtherSurfacesDoNotCount) {
    for (const bool is_turned : {false, true}) {
        scene = [&](const CameraRay& ray) {
            const bool is_left = ray.origin.x < 0;
            return SyntheticHit{.distance = 10,
                                .normal = is_turned && !is_left ? glm::vec3(0.8f, 0, 0.6f) : glm::vec3(0, 0, 1),
                                .roughness = is_turned || is_left ? 0.5f : 0.75f,
                                .metalness = 1,
                                .specular = 1};
        };
        frame = 0;
        params.assign({{"min_radius", 8}, {"max_radius", 1.0}});
        const auto two_colors = [&](glm::uvec2 pixel) {
            return SeenRay{.radiance = glm::vec3(pixel.x < extent.x / 2 ? 1.0f : 5.0f)};
        };
        const HostImage shown = next(two_colors);
        unsigned mixed = 0;
        for (unsigned x = 0; x < extent.x; ++x)
            if (x < extent.x / 2)
                EXPECT_NEAR(*shown.pixel(x, 16), 1, 1e-4f) << x;
            else
                mixed += *shown.pixel(x, 16) < 4.9f;
        EXPECT_EQ(mixed > 0, !is_turned) << "rough ones take from smooth ones";
    }
}

/// A parallel wall of radiance 1 is 1 in the mean, though neighbours lie as far apart as it is away.
TEST_F(ReservoirsTest, NearWallsKeepTheirRadiance) {
    roughness = 0.5f;
    params.assign({{"min_radius", 8}, {"max_radius", 1.0}});
    const HostImage shown = next([&](glm::uvec2) {
        const glm::vec3 direction = drawn();
        return SeenRay{.direction = direction, .length = 1 / direction.z};
    });
    EXPECT_NEAR(mean_of(shown), 1, 0.03);
}

TEST_F(ReservoirsTest, StaysFiniteAndInRange) {
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(33, 17)})
        for (const bool orthographic : {false, true})
            for (const float perceptual : {0.0f, 0.05f, 0.6f}) {
                extent = size;
                is_orthographic = orthographic;
                roughness = perceptual;
                frame = 0;
                for (int i = 0; i < 3; ++i) {
                    const HostImage shown = next([&](glm::uvec2) -> std::optional<SeenRay> {
                        if (uniform() < 0.2f) return std::nullopt;
                        return SeenRay{.direction = uniform() < 0.5f ? drawn() : glm::vec3(0, 0, -1),
                                       .length = std::pow(10.0f, 8 * uniform() - 5),
                                       .radiance = glm::vec3(uniform() < 0.3f ? 0 : std::pow(10.0f, 12 * uniform())),
                                       .known = uniform()};
                    });
                    for (const float value : shown.values) ASSERT_TRUE(std::isfinite(value) && value >= 0) << value;
                    for (size_t i = 3; i < shown.values.size(); i += 4) ASSERT_LE(shown.values[i], 1);
                }
            }
}

}  // namespace
