#include "core/gbuffer/environment_images.h"
#include "core/split_sum.h"
#include "tests/variants/frostbite_reference.h"
#include "tests/variants/technique_fixture.h"
#include "variants/common/ggx_lobe.h"

#include <glm/gtc/matrix_transform.hpp>
#include <random>

// Every switch of the resolve against sums in double precision, over surfaces and rays made up at random.

namespace {

constexpr glm::uvec2 extent{47, 30};

/// Of the camera: no row or column stands in for another.
const glm::mat3 world_from_view = glm::mat3(glm::rotate(glm::mat4(1), 0.6f, glm::vec3(0.5f, 1, 0.3f)));

/// Hills whose normals are not those of their shape, with pieces of sky.
SyntheticHit hills(const CameraRay& ray) {
    const glm::vec3 direction = transpose(world_from_view) * ray.direction;
    const glm::vec2 at = glm::vec2(direction) / -direction.z;
    if (at.y > 0.45f) return {};
    const glm::vec3 normal(0.4f * std::sin(7 * at.x), 0.4f * std::cos(9 * at.y), 1);
    return {.distance = 5 + std::sin(3 * at.x) + std::cos(5 * at.y),
            .normal = world_from_view * normalize(normal),
            .roughness = 0.45f + 0.2f * std::sin(11 * at.x + 5 * at.y),
            .metalness = 0.5f + 0.5f * std::sin(4 * at.x),
            .specular = 0.8f,
            .lit = {},
            .dielectric_f0 = {0.5f + 0.4f * std::sin(3 * at.y), 0.1f, 0.02f}};
}

glm::dvec3 gradient(glm::dvec2 place) {
    const glm::dvec2 centre = clamp(place, glm::dvec2(0.5), glm::dvec2(extent) - 0.5);
    return {0.1 + centre.x / extent.x, 0.3 + centre.y / extent.y, 1.5 - centre.x / extent.x};
}

HostImage gradient_image() {
    HostImage image(extent, 4);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) image.set_rgb(y * extent.x + x, gradient(glm::dvec2(x, y) + 0.5));
    return image;
}

struct FrostbiteResolve : TechniqueTest {
    std::mt19937 random{4};
    const CameraPose pose{.world_from_view = glm::mat4(world_from_view), .vertical_fov = 1};
    const FrameView view{.extent = extent, .jitter = {0.3f, -0.2f}, .previous_jitter = {-0.1f, 0.4f}};
    const Environment environment{.type = Environment::Type::gradient,
                                  .color = {1, 1.5f, 2},
                                  .slope = {0.9f, -1.2f, 0.4f},
                                  .axis = glm::normalize(glm::vec3(0.7f, 0.3f, -0.5f))};

    float uniform() { return float(random() >> 8) * 0x1p-24f; }

    /// Colours, geometric normals and motions of pixels that have nothing to do with each other.
    void scatter(FrostbiteBench& bench) {
        HostImage color(extent, 4), normal(extent, 4), motion(extent, 2);
        const HostImage base_color = bench.pass_list.download(bench.gbuffer.base_color);
        for (size_t i = 0; i < color.pixel_count(); ++i) {
            color.set_rgb(i, {uniform(), uniform(), uniform()});
            color.values[4 * i + 3] = base_color.values[4 * i + 3];
            normal.set_rgb(i, normalize(glm::vec3(uniform() - 0.5f, uniform() - 0.5f, uniform())));
            for (unsigned c = 0; c < 2; ++c) motion.values[2 * i + c] = 0.2f * (uniform() - 0.5f);
        }
        bench.pass_list.upload(bench.gbuffer.base_color, color);
        bench.pass_list.upload(bench.gbuffer.geometric_normal, normal);
        bench.pass_list.upload(bench.gbuffer.motion, motion);
        bench.camera.frame.w = 1;
    }

    /// Rays of all kinds; some pixels have fewer than max_rays.
    std::vector<StoredRay> some_rays(const FrostbiteBench& bench) {
        const glm::uvec2 traced = bench.traced_extent();
        std::vector<StoredRay> rays(size_t(traced.x) * traced.y * unsigned(bench.ray_parameters.max_rays));
        for (StoredRay& ray : rays) {
            if (uniform() < 0.1f) continue;
            const glm::vec3 n = normalize(glm::vec3(uniform() - 0.5f, uniform() - 0.5f, 1)), o(0, 0, 1);
            const glm::mat3 view_from_local = basis_from_normal(n);
            const LobeSample drawn =
                sample_lobe(uniform() < 0.5f, o * view_from_local, 0.3f, 0.3f, {uniform(), uniform()});
            ray.direction = view_from_local * drawn.direction;
            ray.inverse_density = drawn.inverse_density;
            ray.length = 0.5f * std::exp(3 * uniform());
            ray.confidence = uniform();
            ray.target = unsigned(uniform() * float(extent.x)) | unsigned(uniform() * float(extent.y)) << 16;
            const float kind = uniform();
            if (kind < 0.2f) ray.target = ray_missed;
            if (kind > 0.9f) ray.target = ray_into_surface;
            if (drawn.direction.z <= 0 || kind > 0.95f) ray.target = ray_below_horizon;
            if (ray.target >= ray_into_surface) ray.length = 0;
        }
        return rays;
    }

    /// Those of quad_shared with 4 taps.
    std::vector<glm::uvec2> taps_of(const FrostbiteBench& bench, glm::uvec2 pixel) {
        const bool is_half = bench.ray_parameters.half_resolution;
        const glm::uvec2 first = is_half ? pixel / 2u : pixel / 2u * 2u, last = bench.traced_extent() - 1u;
        std::vector<glm::uvec2> taps;
        for (unsigned k = 0; k < 4; ++k) {
            const glm::uvec2 tap = min(first + glm::uvec2(k % 2, k / 2), last);
            if (std::ranges::find(taps, tap) == taps.end()) taps.push_back(tap);
        }
        return taps;
    }

    void expect_reference(const nlohmann::json& overrides) {
        nlohmann::json parameters = {{"taps", "4"},   {"pattern", "quad_shared"}, {"filtered_sampling", false},
                                     {"max_rays", 2}, {"max_roughness", 0.6},     {"importance_bias", 0.3}};
        parameters.update(overrides);
        FrostbiteBench bench(device(), pose, view, hills, parameters);
        const EnvironmentImages images(bench.pass_list, environment, false);
        bench.gbuffer.environment = &images;
        scatter(bench);
        bench.set_frame(2, 5);
        const std::vector<StoredRay> rays = some_rays(bench);
        const ResolvedFrame found = bench.resolve(rays, gradient_image());
        const FrostbiteReference reference(bench, rays, environment);
        const HostImage normal = bench.pass_list.download(bench.gbuffer.normal),
                        depth = bench.pass_list.download(bench.gbuffer.depth);
        unsigned compared = 0, close_calls = 0;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const glm::dvec4 pixel(found.radiance.pixel(x, y)[0], found.radiance.pixel(x, y)[1],
                                       found.radiance.pixel(x, y)[2], found.radiance.pixel(x, y)[3]);
                if (*depth.pixel(x, y) == 1 || normal.pixel(x, y)[3] > 0.6f) {
                    ASSERT_EQ(pixel, glm::dvec4(0)) << x << ", " << y;
                    continue;
                }
                auto expected = reference.resolve({x, y}, taps_of(bench, {x, y}), gradient);
                close_calls += expected.is_close_call;
                if (expected.is_close_call) continue;
                ++compared;
                // Positions at six metres and normals are known to 3e-7 of them: 1e-5 of a direction re-aimed over half
                // a metre, which the narrowest lobe (alpha 0.06) turns into 1e-3 of a weight. Filtering rounds places
                // between texels to 1 / 256: 1e-4 of the gradient.
                const double tolerance = 3e-3 * (1 + length(expected.radiance));
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(pixel[c], expected.radiance[c], tolerance) << x << ", " << y << " of " << parameters;
                ASSERT_NEAR(pixel.w, expected.confidence, 3e-3) << x << ", " << y << " of " << parameters;
                ASSERT_NEAR(*found.length.pixel(x, y), expected.length, 3e-3 * (1 + expected.length))
                    << x << ", " << y << " of " << parameters;
            }
        EXPECT_GT(compared, 500u) << parameters;
        EXPECT_LT(close_calls, 50u) << parameters;
    }
};

TEST_F(FrostbiteResolve, EqualsTheSumsOfEachEstimator) {
    expect_reference(nlohmann::json::object());
    expect_reference({{"estimator", "c"}, {"lobe", "visible_normals"}});
    expect_reference({{"estimator", "c"}, {"misses", "fallback"}});
    // Times the integral of the BRDF b needs no table, whose error would hide others.
    for (const char* lobe : {"normals", "visible_normals"})
        expect_reference(
            {{"estimator", "b"}, {"lobe", lobe}, {"reflectance_after_filter", false}, {"max_regenerations", 0}});
    expect_reference(
        {{"estimator", "b"}, {"misses", "fallback"}, {"reflectance_after_filter", false}, {"max_regenerations", 0}});
}

TEST_F(FrostbiteResolve, EqualsTheSumsForEachReuseAndLength) {
    expect_reference({{"neighbor_ray", "direction"}, {"reflection_depth", "min"}});
    expect_reference({{"reuse_jacobian", true}, {"reflection_depth", "max"}, {"lobe", "visible_normals"}});
    expect_reference({{"reuse_jacobian", true}, {"half_resolution", false}});
    expect_reference({{"half_resolution", false}, {"misses", "fallback"}});
    expect_reference({{"previous_frame", false}, {"max_rays", 4}});
}

TEST_F(FrostbiteResolve, NeverExceedsTheBrightestTap) {
    for (const char* estimator : {"a", "c"})
        for (const char* taps : {"4", "16"}) {
            FrostbiteBench bench(device(), pose, view, hills,
                                 {{"taps", taps}, {"estimator", estimator}, {"previous_frame", false}});
            HostImage color(extent, 4);
            for (size_t i = 0; i < color.pixel_count(); ++i) color.set_rgb(i, {uniform(), 2 * uniform(), 7});
            const HostImage found = bench.resolve(some_rays(bench), color).radiance;
            for (size_t i = 0; i < found.pixel_count(); ++i) {
                const glm::vec3 radiance = found.rgb(i);
                const float rounding = 1 + 1e-5f;
                ASSERT_TRUE(radiance.x <= rounding && radiance.y <= 2 * rounding && radiance.z <= 7 * rounding) << i;
                ASSERT_TRUE(radiance.x >= 0 && radiance.y >= 0 && radiance.z >= 0) << i;
                const float confidence = found.values[4 * i + 3];
                ASSERT_TRUE(confidence >= 0 && confidence <= rounding) << i;
            }
        }
}

/// The table of the integral divides what b finds, and multiplies what a finds.
TEST_F(FrostbiteResolve, AppliesTheReflectanceBeforeOrAfterTheFilter) {
    for (const char* estimator : {"a", "b", "c"}) {
        HostImage found[2];
        HostImage normal;
        for (const bool is_after : {false, true}) {
            random.seed(6);
            FrostbiteBench bench(device(), pose, view, hills,
                                 {{"estimator", estimator}, {"reflectance_after_filter", is_after}});
            normal = bench.pass_list.download(bench.gbuffer.normal);
            found[is_after] = bench.resolve(some_rays(bench), gradient_image()).radiance;
        }
        unsigned compared = 0;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const float* after = found[true].pixel(x, y);
                if (after[0] == 0) continue;
                ++compared;
                const glm::vec2 screen = glm::vec2(x, y) + 0.5f + view.jitter;
                const CameraRay ray = camera_ray(pose, extent, screen);
                const SyntheticHit hit = hills(ray);
                const glm::vec2 ab =
                    read_split_sum(default_split_sum_table(), -dot(hit.normal, ray.direction), hit.roughness);
                const glm::vec3 f0 = specular_f0(glm::vec3(1), hit.metalness, hit.specular, hit.dielectric_f0);
                const glm::vec3 reflectance = f0 * ab.x + specular_f90(hit.metalness, hit.specular) * ab.y;
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(found[false].pixel(x, y)[c], after[c] * reflectance[c], 1e-4f * (1 + after[c]));
            }
        EXPECT_GT(compared, 500u) << estimator;
    }
}

/// Their lobes are narrow, not infinitely so: neighbours' rays weigh in, but next to nothing.
TEST_F(FrostbiteResolve, MirrorsShowTheirOwnRay) {
    const SyntheticScene mirror = [](const CameraRay& ray) {
        SyntheticHit hit = hills(ray);
        hit.normal = normalize(world_from_view * glm::vec3(0, 0.3f, 1));
        hit.roughness = 0;
        return hit;
    };
    for (const char* estimator : {"a", "b", "c"}) {
        FrostbiteBench bench(device(), pose, view, mirror,
                             {{"half_resolution", false}, {"estimator", estimator}, {"previous_frame", false}});
        const glm::mat3 view_from_world = glm::mat3(bench.camera.view_from_world);
        HostImage color(extent, 4);
        std::vector<StoredRay> rays(color.pixel_count());
        for (unsigned i = 0; i < rays.size(); ++i) {
            const glm::vec2 screen = glm::vec2(i % extent.x, i / extent.x) + 0.5f + view.jitter;
            const CameraRay ray = camera_ray(pose, extent, screen);
            const glm::vec3 n = view_from_world * mirror(ray).normal;
            const glm::mat3 view_from_local = basis_from_normal(n);
            const LobeSample drawn = sample_lobe(lobe_of_normals, -(view_from_world * ray.direction) * view_from_local,
                                                 ggx_alpha(0), 0.7f, {uniform(), uniform()});
            rays[i] = {.direction = view_from_local * drawn.direction,
                       .inverse_density = drawn.inverse_density,
                       .target = i % extent.x | i / extent.x << 16,
                       .length = 3 + uniform()};
            color.set_rgb(i, {uniform(), 1, 1});
        }
        const HostImage found = bench.resolve(rays, color).radiance;
        unsigned own = 0, mirrors = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_TRUE(std::isfinite(found.values[4 * i]) && std::isfinite(found.values[4 * i + 3])) << i;
            if (found.values[4 * i + 3] == 0) continue;
            ++mirrors;
            own += std::abs(found.values[4 * i] - color.values[4 * i]) < 0.02f;
        }
        EXPECT_GT(mirrors, 500u);
        EXPECT_GT(own, mirrors * 9 / 10) << estimator;
    }
}

/// Two halves of a wall whose geometric normals lean to either side under one shading normal, and rays that all go to
/// the left at a low angle: into the right half's surface, out of the left one's, where they hit what shines. Whoever
/// traced a ray, the left half sees the light and the right half black; nobody is darkened by what is black for a
/// neighbour.
TEST_F(FrostbiteResolve, JudgesEveryRayByTheSurfaceOfThePixelThatReusesIt) {
    const auto wall = [](const CameraRay& ray) {
        return SyntheticHit{.distance = -5 / ray.direction.z, .roughness = 0.5f, .metalness = 1, .specular = 1};
    };
    for (const char* neighbor_ray : {"hit_point", "direction"}) {
        FrostbiteBench bench(device(), {.is_orthographic = true, .orthographic_height = 0.01f}, {.extent = extent},
                             wall,
                             {{"half_resolution", false},
                              {"previous_frame", false},
                              {"filtered_sampling", false},
                              {"taps", "16"},
                              {"neighbor_ray", neighbor_ray}});
        const glm::vec3 direction = normalize(glm::vec3(-1, 0, 0.3f));
        HostImage geometric(extent, 4), color(extent, 4, 1.0f);
        std::vector<StoredRay> rays(color.pixel_count());
        for (unsigned i = 0; i < rays.size(); ++i) {
            const bool is_left = i % extent.x < extent.x / 2;
            geometric.set_rgb(i, normalize(glm::vec3(is_left ? -0.6f : 0.6f, 0, 1)));
            rays[i] = {.direction = direction,
                       .inverse_density = 1,
                       .target = is_left ? 7 | 7 << 16 : ray_into_surface,
                       .length = is_left ? 3.0f : 0.0f};
        }
        bench.pass_list.upload(bench.gbuffer.geometric_normal, geometric);
        const ResolvedFrame found = bench.resolve(rays, color);
        for (unsigned i = 0; i < rays.size(); ++i) {
            const bool is_left = i % extent.x < extent.x / 2;
            ASSERT_NEAR(found.radiance.values[4 * i], is_left ? 1 : 0, 1e-5) << i << ", " << neighbor_ray;
            ASSERT_NEAR(found.radiance.values[4 * i + 3], 1, 1e-5) << i << ", " << neighbor_ray;
            ASSERT_NEAR(found.length.values[i], is_left ? 3 : 0, 0.01) << i << ", " << neighbor_ray;
        }
    }
}

TEST_F(FrostbiteResolve, LeavesPixelsWithoutRaysToTheFallback) {
    for (const char* estimator : {"a", "b", "c"})
        for (const bool are_below_horizon : {false, true}) {
            FrostbiteBench bench(device(), pose, view, hills, {{"estimator", estimator}});
            const glm::uvec2 traced = bench.traced_extent();
            std::vector<StoredRay> rays(size_t(traced.x) * traced.y);
            for (StoredRay& ray : rays)
                if (are_below_horizon) ray = {{0, 0.2f, -0.98f}, 1, ray_below_horizon};
            const ResolvedFrame found = bench.resolve(rays, gradient_image());
            for (size_t i = 0; i < found.length.pixel_count(); ++i) {
                EXPECT_EQ(found.radiance.rgb(i), glm::vec3(0));
                EXPECT_EQ(found.length.values[i], 0);
                // In b such draws are known to bring nothing.
                const bool is_known = are_below_horizon && estimator == std::string("b");
                if (!is_known) {
                    EXPECT_EQ(found.radiance.values[4 * i + 3], 0);
                }
            }
        }
}

}  // namespace
