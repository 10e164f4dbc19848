// The ratio filter against closed forms: what its averages, its history and its weights come to.
#include "tests/variants/frostbite_bench.h"
#include "tests/variants/frostbite_passes.h"
#include "variants/denoisers/denoisers.h"

#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>

namespace {

SyntheticScene wall(float roughness) {
    return [roughness](const CameraRay& ray) {
        return SyntheticHit{.distance = (-5 - ray.origin.z) / ray.direction.z,
                            .normal = {0, 0, 1},
                            .roughness = roughness,
                            .metalness = 1,
                            .specular = 1};
    };
}

/// Frames in a row before a camera that is held, with rays that a test makes up.
struct RatioFilterBench {
    PassList pass_list;
    CameraPose pose, pose_before;
    FrameView view;
    SyntheticScene scene;
    FrostbiteParameters technique;  ///< among them those of its rays
    std::unique_ptr<Denoiser> denoiser = std::make_unique<Denoiser>(find_denoiser("ratio_filter"));

    RatioFilterBench(Device& device, const CameraPose& camera, const FrameView& frame, const SyntheticScene& shown,
                     const nlohmann::json& of_technique, const nlohmann::json& own)
        : pass_list(device, frame.extent), pose(camera), view(frame), scene(shown) {
        technique.params.assign({{"half_resolution", false}, {"previous_frame", false}, {"max_roughness", 1.0}});
        technique.params.assign(of_technique);
        denoiser->params.assign(own);
    }

    /// `rays`: max_rays for each traced pixel. `color`: what hits show, 4 channels.
    HostImage next(const std::vector<StoredRay>& rays, const HostImage& color) {
        const CameraData camera = camera_data(pose, view.frame > 0 ? &pose_before : nullptr, view);
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        pass_list.begin_frame(camera, technique.params, gbuffer.images());
        const Image lit = pass_list.image("shown_by_hits", Format::rgba32f);
        pass_list.upload(lit, color);
        const DenoisedRays traced{
            .technique = technique.params, .traced = upload_rays(pass_list, rays), .color = lit, .probe = {}};
        const Reflections reflections = denoiser->run(pass_list, gbuffer, traced);
        ++view.frame;
        pose_before = pose;
        return pass_list.download(reflections.radiance);
    }

    size_t traced_pixels() const {
        const glm::uvec2 extent = technique.ray.half_resolution ? (view.extent + 1u) / 2u : view.extent;
        return size_t(extent.x) * extent.y;
    }
};

struct RatioFilter : TechniqueTest {
    const nlohmann::json of_own_rays = {{"spatial_reuse", false}, {"bilateral_filter", false}};
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {32, 24}};
    std::mt19937 random{1};
    std::uniform_real_distribution<float> uniform{0, 1};

    unsigned any_pixel() { return unsigned(random() % view.extent.x) | unsigned(random() % view.extent.y) << 16; }

    /// Uniform over the hemisphere of the wall.
    glm::vec3 any_direction() {
        const float z = uniform(random), turn = 2 * glm::pi<float>() * uniform(random), r = std::sqrt(1 - z * z);
        return {r * std::cos(turn), r * std::sin(turn), z};
    }

    float any_of(const std::vector<float>& values) { return values[random() % values.size()]; }

    /// Each pixel's ray hits the pixel itself.
    std::vector<StoredRay> rays_to_themselves() const {
        std::vector<StoredRay> rays;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x)
                rays.push_back({.direction = {0, 0, 1}, .inverse_density = 1, .target = x | y << 16, .length = 1});
        return rays;
    }

    HostImage any_colors() {
        HostImage colors(view.extent, 4, 1);
        for (size_t i = 0; i < colors.pixel_count(); ++i)
            colors.set_rgb(i, 2.0f * glm::vec3(uniform(random), uniform(random), uniform(random)));
        return colors;
    }
};

/// Whatever the weights and however many rays miss; up to the rounding of colours times confidences, some of them
/// small.
TEST_F(RatioFilter, KeepsConstantRadiance) {
    const glm::vec3 radiance(3, 2, 0.5f);
    HostImage color(view.extent, 4, 1);
    for (size_t i = 0; i < color.pixel_count(); ++i) color.set_rgb(i, radiance);
    for (const bool is_linear : {false, true}) {
        RatioFilterBench bench(device(), pose, view, wall(0.4f), {{"half_resolution", is_linear}},
                               {{"averages", is_linear ? "linear" : "logarithmic"}, {"bilateral_variance", 0.0}});
        for (int frame = 0; frame < 4; ++frame) {
            std::vector<StoredRay> rays(bench.traced_pixels());
            for (StoredRay& ray : rays)
                ray = {.direction = any_direction(),
                       .inverse_density = 0.1f + uniform(random),
                       .target = uniform(random) < 0.3f ? ray_missed : any_pixel(),
                       .length = 0.1f + uniform(random),
                       .confidence = uniform(random)};
            const HostImage found = bench.next(rays, color);
            for (size_t i = 0; i < found.pixel_count(); ++i) {
                const float* pixel = &found.values[4 * i];
                ASSERT_GT(pixel[3], 0);
                ASSERT_LT(pixel[3], 1);
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c] / radiance[c], 1, 1e-4) << is_linear << frame;
            }
        }
    }
}

TEST_F(RatioFilter, PassesRaysOfMirrorsBitForBit) {
    RatioFilterBench bench(device(), pose, view, wall(0), nlohmann::json::object(), nlohmann::json::object());
    const HostImage color = any_colors();
    EXPECT_EQ(bench.next(rays_to_themselves(), color).values, color.values);
}

/// With half_resolution the original has five rays or more; without neighbours mirrors have those of their 2x2 pixels.
TEST_F(RatioFilter, PassesRaysOfTracedMirrorsWithSharpMirrors) {
    const HostImage color = any_colors();
    for (const bool sharp_mirrors : {false, true}) {
        RatioFilterBench bench(device(), pose, view, wall(0), {{"half_resolution", true}},
                               {{"sharp_mirrors", sharp_mirrors}});
        std::vector<StoredRay> rays;
        for (unsigned y = 0; y < view.extent.y; y += 2)
            for (unsigned x = 0; x < view.extent.x; x += 2)
                rays.push_back({.direction = {0, 0, 1}, .inverse_density = 1, .target = x | y << 16, .length = 1});
        const HostImage found = bench.next(rays, color);
        unsigned same = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) same += *found.pixel(x, y) == *color.pixel(x & ~1u, y & ~1u);
        if (sharp_mirrors) {
            EXPECT_EQ(same, view.extent.x * view.extent.y);
        } else {
            EXPECT_LT(same, 10u);
        }
    }
}

/// Of rays of equal weight half see nothing: the logarithmic mean of 0 and x is sqrt(1 + x) - 1.
TEST_F(RatioFilter, AveragesLogarithmsOrColors) {
    HostImage color(view.extent, 4, 1);
    color.set_rgb(0, glm::vec3(0)), color.set_rgb(1, glm::vec3(100, 8, 3));
    std::vector<StoredRay> rays;
    for (size_t i = 0; i < 2 * color.pixel_count(); ++i)
        rays.push_back({.direction = {0, 0, 1}, .inverse_density = 1, .target = unsigned(i % 2), .length = 1});
    for (const bool is_logarithmic : {true, false}) {
        RatioFilterBench bench(device(), pose, view, wall(0.4f), {{"max_rays", 2}},
                               {{"spatial_reuse", false}, {"averages", is_logarithmic ? "logarithmic" : "linear"}});
        const HostImage found = bench.next(rays, color);
        for (int c = 0; c < 3; ++c) {
            const float x = color.values[4 + c], mean = is_logarithmic ? std::sqrt(1 + x) - 1 : x / 2;
            EXPECT_NEAR(found.values[c] / mean, 1, 1e-5);
        }
    }
}

/// Without scatter history has 0.97 * 0.75 of the weight: what came k frames ago has (1 - w) w^k, and the average of
/// independent values (1 - w) / (1 + w) of their variance. The variance of 768 pixels times three channels has a
/// standard error of 3 to 4 %, as averages of many values are nearly normal: 15 % are 4 of them, a false alarm in
/// 16000.
TEST_F(RatioFilter, HistoryIsARunningMean) {
    const double weight = 0.97 * 0.75;
    nlohmann::json own = of_own_rays;
    own["clamp_deviations"] = 1e6;
    RatioFilterBench bench(device(), pose, view, wall(0.4f), nlohmann::json::object(), own);
    std::vector<double> expected(3 * view.extent.x * view.extent.y);
    HostImage found;
    for (int frame = 0; frame < 24; ++frame) {
        const HostImage color = any_colors();
        found = bench.next(rays_to_themselves(), color);
        for (size_t i = 0; i < expected.size(); ++i) {
            const double now = color.values[i / 3 * 4 + i % 3];
            expected[i] = frame == 0 ? now : glm::mix(now, expected[i], weight);
            // Projecting a still point and back moves it by up to 1e-4 pixels, by which neighbours up to 2 apart are
            // mixed in.
            ASSERT_NEAR(found.values[i / 3 * 4 + i % 3], expected[i], 1e-3) << frame;
        }
    }
    double sum = 0, squares = 0;
    for (size_t i = 0; i < found.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double value = found.values[4 * i + size_t(c)];
            sum += value, squares += value * value;
        }
    const double n = double(expected.size()), variance = squares / n - sum * sum / n / n;
    const double of_one = 4.0 / 12;  // uniform from 0 to 2
    EXPECT_NEAR(variance / of_one / ((1 - weight) / (1 + weight)), 1, 0.15);
}

/// Where nothing scatters the least deviation is 1e-4, of four times the luminance: history that lies 31.5 of them away
/// in sum has no weight in the original, and what lies nearer is moved to within one.
TEST_F(RatioFilter, ForgetsOrClampsHistoryByDeviations) {
    HostImage before(view.extent, 4, 1), now(view.extent, 4, 1);
    for (const float difference : {0.5e-3f, 0.7e-3f, 0.9e-3f}) {
        RatioFilterBench bench(device(), pose, view, wall(0.4f), nlohmann::json::object(), of_own_rays);
        before.set_rgb(0, glm::vec3(1 + difference));
        for (size_t i = 0; i < before.pixel_count(); ++i) before.set_rgb(i, glm::vec3(1 + difference));
        bench.next(rays_to_themselves(), before);
        const HostImage found = bench.next(rays_to_themselves(), now);
        const float shown = 4 * difference < 31.5e-4f ? 0.97f * 0.75f * 1e-4f / 4 : 0;
        for (size_t i = 0; i < found.pixel_count(); ++i)
            for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(found.values[4 * i + c] - 1, shown, 1e-6) << difference;
    }
}

/// What lies 3 m before a wall 5 m away is mirrored 8 m away, and brighter from left to right; the camera moves by 2 m.
/// The mirror image is as bright as before. In the original it seems to lie farther away off the axis, so that what is
/// found is what lay beside it.
TEST_F(RatioFilter, LooksForHistoryWhereTheMirrorImageWas) {
    const float distance = 5, to_object = 3, way = 2, slope = 0.1f;
    for (const bool is_exact : {false, true}) {
        nlohmann::json own = of_own_rays;
        own.update({{"exact_mirror_image", is_exact}, {"clamp_deviations", 1e6}});
        RatioFilterBench bench(device(), pose, view, wall(0.4f), nlohmann::json::object(), own);
        HostImage color(view.extent, 4, 1), found;
        std::vector<StoredRay> rays = rays_to_themselves();
        const auto ray_at = [&](unsigned x, unsigned y) {
            return camera_ray(bench.pose, view.extent, glm::vec2(x, y) + 0.5f);
        };
        for (const float place : {-way, 0.0f}) {
            bench.pose.world_from_view = glm::translate(glm::mat4(1), glm::vec3(place, 0, 0));
            for (unsigned y = 0; y < view.extent.y; ++y)
                for (unsigned x = 0; x < view.extent.x; ++x) {
                    const glm::vec3 direction = ray_at(x, y).direction;
                    const float image_x = place - direction.x / direction.z * (distance + to_object);
                    color.set_rgb(y * view.extent.x + x, glm::vec3(2 + slope * image_x));
                    rays[y * view.extent.x + x].length = -to_object / direction.z;
                }
            found = bench.next(rays, color);
        }
        const unsigned moved = 8;  // pixels: more than the surface did
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 1; x < view.extent.x - moved; ++x) {
                const float stretch = is_exact ? 1 : -1 / ray_at(x, y).direction.z;
                const float beside = way * ((distance + to_object) / (distance + stretch * to_object) - 1);
                // The history of the surface, 0.12 brighter, still has a weight of up to 2^-10 of the other.
                ASSERT_NEAR(*found.pixel(x, y), *color.pixel(x, y) + 0.97f * 0.75f * slope * beside, 3e-4) << is_exact;
            }
    }
}

/// To a wall that faces the camera, neighbours on its plane are where they are, up to the roughness from which the
/// original draws them nearer.
TEST_F(RatioFilter, SeesHitsOfNeighborsFromThePixel) {
    const HostImage color = any_colors();
    std::vector<StoredRay> rays(color.pixel_count());
    for (StoredRay& ray : rays)
        ray = {.direction = glm::normalize(any_direction() + glm::vec3(0, 0, 1)),
               .inverse_density = 1,
               .target = any_pixel(),
               .length = 1 + uniform(random)};
    std::map<std::string, HostImage> found;
    for (const char* neighbor_ray : {"plane", "hit_point", "direction"})
        found[neighbor_ray] = RatioFilterBench(device(), pose, view, wall(0.29f), nlohmann::json::object(),
                                               {{"neighbor_ray", neighbor_ray}, {"bilateral_filter", false}})
                                  .next(rays, color);
    unsigned others = 0;
    for (size_t i = 0; i < color.values.size(); ++i) {
        ASSERT_NEAR(found["plane"].values[i], found["hit_point"].values[i], 1e-3);
        others += std::abs(found["direction"].values[i] - found["hit_point"].values[i]) > 1e-2f;
    }
    EXPECT_GT(others, color.pixel_count());
}

/// Two walls 1 m apart, each with two colours as a checkerboard: each wall's mix, nothing of the other's.
TEST_F(RatioFilter, BilateralFilterStaysOnThePlane) {
    const SyntheticScene step = [](const CameraRay& ray) {
        SyntheticHit hit = wall(0.4f)(ray);
        if (ray.direction.x > 0) hit.distance *= 1.2f;
        return hit;
    };
    HostImage color(view.extent, 4, 1);
    const auto is_left = [&](size_t i) { return i % view.extent.x < view.extent.x / 2; };
    for (size_t i = 0; i < color.pixel_count(); ++i)
        color.set_rgb(i, glm::vec3((is_left(i) ? 1.0f : 10.0f) * ((i + i / view.extent.x) % 2 == 0 ? 1.0f : 2.0f)));
    const nlohmann::json own = {{"spatial_reuse", false}, {"bilateral_variance", 0.0}, {"bilateral_size", "roughness"}};
    const HostImage found =
        RatioFilterBench(device(), pose, view, step, nlohmann::json::object(), own).next(rays_to_themselves(), color);
    unsigned mixed = 0;
    for (size_t i = 0; i < color.pixel_count(); ++i) {
        const float unit = is_left(i) ? 1.0f : 10.0f, value = found.values[4 * i] / unit;
        ASSERT_GE(value, 1 - 1e-5f);
        ASSERT_LE(value, 2 + 1e-5f);
        mixed += value > 1.2f && value < 1.8f;
    }
    EXPECT_GT(mixed, color.pixel_count() * 9 / 10);
}

/// On a wall of alpha 1, seen straight, rays are as dense everywhere; what they see is the cosine of their direction.
/// The mean over the lobe of visible normals is 1/2; over what the BRDF reflects, (ln 2 - 1/2) / (1 - ln 2). A ratio of
/// some 60 rays is too large by 0.002: the integral of w^2 (cosine - mean) over that of w squared is 0.08, over their
/// number. Each of 16 frames has its own rays, so that a value 6 standard errors off is a false alarm in 40000
/// (Student's t, 15 degrees of freedom).
TEST_F(RatioFilter, NumeratorDecidesWhatIsAveraged) {
    view.extent = {32, 32};
    pose.is_orthographic = true;
    HostImage cosines(view.extent, 4, 1);
    const size_t count = cosines.pixel_count();
    for (size_t i = 0; i < count; ++i) cosines.set_rgb(i, glm::vec3((float(i) + 0.5f) / float(count)));
    const double ln2 = std::log(2.0);
    for (const bool is_brdf : {false, true}) {
        std::vector<double> means;
        RatioFilterBench bench(device(), pose, view, wall(1), {{"max_rays", 4}},
                               {{"temporal_accumulation", false},
                                {"bilateral_filter", false},
                                {"averages", "linear"},
                                {"neighbor_ray", "direction"},
                                {"numerator", is_brdf ? "brdf" : "density"}});
        for (unsigned frame = 0; frame < 16; ++frame) {
            std::vector<StoredRay> rays(4 * count);
            for (StoredRay& ray : rays) {
                const glm::vec3 direction = any_direction();
                const unsigned pixel = std::min(unsigned(direction.z * float(count)), unsigned(count) - 1);
                ray = {.direction = direction,
                       .inverse_density = 2 * glm::pi<float>(),
                       .target = pixel % view.extent.x | pixel / view.extent.x << 16,
                       .length = 1};
            }
            const HostImage found = bench.next(rays, cosines);
            double sum = 0;
            for (size_t i = 0; i < count; ++i) sum += found.values[4 * i] / double(count);
            means.push_back(sum);
        }
        double mean = 0, squares = 0;
        for (const double v : means) mean += v / 16;
        for (const double v : means) squares += (v - mean) * (v - mean);
        const double standard_error = std::sqrt(squares / 15 / 16);
        EXPECT_LT(standard_error, 0.002);
        EXPECT_NEAR(mean, is_brdf ? (ln2 - 0.5) / (1 - ln2) + 0.002 : 0.5, 6 * standard_error + 0.001) << is_brdf;
    }
}

/// Whatever is asked of it: radiance, densities and shares from 0 to the largest of floats, single pixels, parallel
/// rays, mirrors.
TEST_F(RatioFilter, StaysFinite) {
    const nlohmann::json corrected = {
        {"numerator", "brdf"},   {"neighbor_ray", "hit_point"}, {"local_horizon", true},      {"reuse_jacobian", true},
        {"sharp_mirrors", true}, {"reflection_depth", "mean"},  {"exact_mirror_image", true}, {"whole_history", true},
        {"test_likeness", true}, {"follow_motion", true},       {"scale_free", true}};
    const nlohmann::json classic = {{"kernel", "box"},
                                    {"neighbor_ray", "direction"},
                                    {"averages", "linear"},
                                    {"variance_mean", "linear"},
                                    {"bilateral_size", "roughness"}};
    struct Case {
        nlohmann::json own;
        glm::uvec2 extent;
        bool is_orthographic;
        float roughness;
    };
    for (const Case& c :
         {Case{nlohmann::json::object(), {1, 1}, true, 0}, Case{nlohmann::json::object(), {31, 17}, false, 0.3f},
          Case{classic, {1, 1}, false, 0.3f}, Case{classic, {31, 17}, true, 0.3f}, Case{corrected, {1, 1}, false, 0},
          Case{corrected, {31, 17}, true, 0.3f}}) {
        pose.is_orthographic = c.is_orthographic;
        view.extent = c.extent;
        RatioFilterBench bench(device(), pose, view, wall(c.roughness), {{"half_resolution", true}}, c.own);
        for (int frame = 0; frame < 3; ++frame) {
            HostImage color(c.extent, 4);
            for (float& v : color.values) v = any_of({0, 1e-38f, 1, 3e38f});
            std::vector<StoredRay> rays(bench.traced_pixels());
            const unsigned ends[] = {any_pixel(), ray_missed, ray_below_horizon, ray_into_surface};
            for (StoredRay& ray : rays)
                ray = {.direction = (uniform(random) < 0.3f ? -1.0f : 1.0f) * any_direction(),
                       .inverse_density = any_of({1e-38f, 1e-30f, 1, 1e30f, 3e38f}),
                       .target = ends[random() % 4],
                       .length = any_of({1e-30f, 1, 1e6f}),
                       .confidence = any_of({0, 1e-38f, 1e-7f, 1})};
            const HostImage found = bench.next(rays, color);
            for (size_t i = 0; i < found.values.size(); ++i) {
                ASSERT_TRUE(std::isfinite(found.values[i])) << c.own;
                ASSERT_GE(found.values[i], 0);
                ASSERT_LE(found.values[i], i % 4 == 3 ? 1.0f : 1e30f);
            }
        }
    }
}

}  // namespace
