#include "tests/variants/frostbite_passes.h"
#include "tests/variants/lobe_quadrature.h"
#include "variants/denoisers/first_turn.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>
#include <map>
#include <set>

// Which rays are listed and what is kept of them.

namespace {

/// A floor whose roughness grows in strips from left to right, 0.01, 0.1, 0.19, 0.2, 0.4, 0.6, 0.7, before a wall;
/// every third strip has no specular term.
SyntheticHit strips(const CameraRay& ray) {
    SyntheticHit hit = mirror_floor(ray);
    if (hit.metalness == 0) return hit;
    const float roughness[] = {0.01f, 0.1f, 0.19f, 0.2f, 0.4f, 0.6f, 0.7f};
    const int strip = int(std::floor(4 * (ray.origin.x + hit.distance * ray.direction.x))) + 700;
    hit.roughness = roughness[strip % 7];
    if (strip % 3 == 0) hit.metalness = hit.specular = 0;
    return hit;
}

struct FrostbiteRaysTest : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {131, 75}};
    PassList pass_list{device(), view.extent};
    FrostbiteParameters parameters;
    CameraData camera{};

    FrostbiteTraced trace(const SyntheticScene& scene, unsigned frame = 0, unsigned seed = 0) {
        camera = camera_data(pose, nullptr, view);
        camera.frame.x = frame;
        camera.frame.y = seed;
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        pass_list.begin_frame(camera, parameters.params, gbuffer.images());
        return trace_frostbite(pass_list, gbuffer, parameters);
    }

    SyntheticHit seen(const SyntheticScene& scene, glm::uvec2 pixel) const {
        return scene(camera_ray(pose, view.extent, glm::vec2(pixel) + 0.5f));
    }

    glm::uvec2 traced_pixel(glm::uvec2 traced, unsigned turn) const {
        if (!parameters.ray.half_resolution) return traced;
        const glm::uvec2 order[] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
        return glm::min(2u * traced + order[(turn + first_turn(camera.frame.y)) % 4], view.extent - 1u);
    }

    /// That exactly the rays of the rules are listed, in the list of their tracer, once, and that exactly they are
    /// there.
    void expect_rays(const SyntheticScene& scene, unsigned turn, const FrostbiteTraced& found) {
        const unsigned max_rays = parameters.ray.max_rays;
        std::multiset<uint32_t> hierarchical, linear;
        for (unsigned y = 0; y < found.extent.y; ++y)
            for (unsigned x = 0; x < found.extent.x; ++x) {
                const glm::uvec2 pixel = traced_pixel({x, y}, turn);
                const SyntheticHit hit = seen(scene, pixel);
                const bool starts = hit.specular > 0 && hit.roughness <= float(parameters.ray.max_roughness);
                const unsigned rays =
                    starts ? unsigned(*found.ray_count.pixel(pixel.x / frostbite_tile, pixel.y / frostbite_tile)) : 0;
                for (unsigned k = 0; k < max_rays; ++k) {
                    const uint32_t index = (y * found.extent.x + x) * max_rays + k;
                    if (k < rays) (hit.roughness < 0.2f ? hierarchical : linear).insert(index);
                    EXPECT_EQ(found.is_ray(index), k < rays) << x << ", " << y << ", " << k;
                }
            }
        EXPECT_EQ(std::multiset<uint32_t>(found.smooth_list.begin(), found.smooth_list.end()), hierarchical);
        EXPECT_EQ(std::multiset<uint32_t>(found.rough_list.begin(), found.rough_list.end()), linear);
        const auto groups = [](size_t rays) { return uint32_t((rays + 63) / 64); };
        EXPECT_EQ(found.arguments, (std::vector<uint32_t>{groups(hierarchical.size()), hierarchical.empty() ? 0u : 1u,
                                                          1, groups(linear.size()), linear.empty() ? 0u : 1u, 1}));
        EXPECT_GT(hierarchical.size(), 100u);
        EXPECT_GT(linear.size(), 100u);
    }
};

TEST_F(FrostbiteRaysTest, AreThoseOfEveryPixelThatReflectsSmoothly) {
    parameters.params.assign({{"classification", false}, {"half_resolution", false}, {"max_rays", 1}});
    expect_rays(strips, 0, trace(strips));
}

TEST_F(FrostbiteRaysTest, AreThoseOfAnotherPixelOfEachQuadInEveryFrameAndSeed) {
    parameters.params.assign({{"classification", false}, {"max_rays", 2}});
    for (const unsigned seed : {0u, 1u, 2u})
        for (unsigned frame = 0; frame < 4; ++frame) expect_rays(strips, frame, trace(strips, frame, seed));
}

TEST_F(FrostbiteRaysTest, AreAsManyAsTheirTileGets) {
    parameters.params.assign({{"max_rays", 4}, {"variance_scale", 0.05}, {"dilate_tiles", false}});
    const FrostbiteTraced found = trace(strips);
    const auto& counts = found.ray_count.values;
    EXPECT_EQ((std::set<float>(counts.begin(), counts.end()).contains(0)), true);
    EXPECT_GT(std::ranges::max(counts), 1);
    expect_rays(strips, 0, found);
}

TEST_F(FrostbiteRaysTest, LeaveNothingOfTheLastFrame) {
    parameters.params.assign({{"classification", false}});
    trace(strips);
    const FrostbiteTraced found = trace([](const CameraRay&) { return SyntheticHit{}; }, 1);
    EXPECT_EQ(found.arguments, (std::vector<uint32_t>{0, 0, 1, 0, 0, 1}));
    for (size_t i = 0; i < found.directions.size(); ++i) EXPECT_FALSE(found.is_ray(i));
}

TEST_F(FrostbiteRaysTest, AreTheSameInEveryRun) {
    parameters.params.assign({{"classification", false}, {"max_rays", 4}});
    const FrostbiteTraced a = trace(strips, 5, 7), b = trace(strips, 5, 7), c = trace(strips, 5, 8);
    EXPECT_EQ(a.directions, b.directions);
    EXPECT_EQ(a.hits, b.hits);
    EXPECT_NE(a.directions, c.directions);
}

// --- What is kept of a ray ---

constexpr uint32_t ray_missed = 0xffffffffu, ray_below_horizon = 0xfffffffeu, ray_into_surface = 0xfffffffdu;

/// A floor of one roughness, 1 m below the camera, below nothing.
SyntheticScene bare_floor(float roughness) {
    return [roughness](const CameraRay& ray) {
        const float distance = -1.0f / ray.direction.y;
        if (distance < 0 || distance > 50) return SyntheticHit{};
        return SyntheticHit{
            .distance = distance, .normal = {0, 1, 0}, .roughness = roughness, .metalness = 1, .specular = 1};
    };
}

/// Markers of all rays.
std::map<uint32_t, size_t> count_targets(const FrostbiteTraced& found) {
    std::map<uint32_t, size_t> counts;
    for (size_t i = 0; i < found.directions.size(); ++i)
        if (found.is_ray(i)) ++counts[found.is_hit(i) ? 0 : found.hits[i].x];
    return counts;
}

TEST_F(FrostbiteRaysTest, KeepFiniteDensitiesAtEveryRoughness) {
    for (const char* lobe : {"normals", "visible_normals"})
        for (const float roughness : {0.0f, 0.01f, 0.02f, 0.033f, 0.1f, 0.3f, 0.6f}) {
            parameters.params.assign({{"classification", false}, {"lobe", lobe}});
            const FrostbiteTraced found = trace(bare_floor(roughness));
            size_t rays = 0;
            for (size_t i = 0; i < found.directions.size(); ++i) {
                if (!found.is_ray(i)) continue;
                ++rays;
                EXPECT_NEAR(glm::length(glm::vec3(found.directions[i])), 1, 1e-5);
                EXPECT_GT(found.directions[i].w, 0) << roughness;
                EXPECT_TRUE(std::isfinite(found.directions[i].w)) << roughness;
            }
            EXPECT_GT(rays, 500u);
        }
}

TEST_F(FrostbiteRaysTest, HitTheWallWhereTheyMeetIt) {
    parameters.params.assign({{"classification", false}, {"max_rays", 4}, {"frostbite.linear_steps", 512}});
    const FrostbiteTraced found = trace(strips);
    size_t hits = 0, beside = 0;
    for (size_t i = 0; i < found.directions.size(); ++i) {
        if (!found.is_ray(i) || !found.is_hit(i)) continue;
        ++hits;
        const glm::uvec2 traced(i / 4 % found.extent.x, i / 4 / found.extent.x), pixel = traced_pixel(traced, 0);
        const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(pixel) + 0.5f);
        const glm::vec3 origin = ray.origin + strips(ray).distance * ray.direction;
        const glm::vec3 met = origin + glm::uintBitsToFloat(found.hits[i].y) * glm::vec3(found.directions[i]);
        EXPECT_EQ(glm::uintBitsToFloat(found.hits[i].z), 1);
        ASSERT_TRUE(glm::all(glm::lessThan(glm::uvec2(found.hit_pixel(i)), view.extent)));
        // Where floor and wall meet, the lowest row of pixels may pass for the floor: the ray then ends behind the
        // wall.
        beside += std::abs(met.z + 6) > 0.01f;
        EXPECT_NEAR(met.z, -6, 0.2f);
    }
    EXPECT_GT(hits, 1000u);
    EXPECT_LT(double(beside), 0.005 * double(hits));
}

TEST_F(FrostbiteRaysTest, AreDrawnAgainWhileTheyGoBelowTheHorizon) {
    pose.vertical_fov = 0.3f;  // grazing
    for (const unsigned draws : {0u, 16u}) {
        parameters.params.assign({{"classification", false}, {"importance_bias", 0.0}, {"max_regenerations", draws}});
        const FrostbiteTraced found = trace(bare_floor(0.6f));
        const auto targets = count_targets(found);
        size_t rays = 0, below = 0;
        for (size_t i = 0; i < found.directions.size(); ++i) {
            if (!found.is_ray(i)) continue;
            ++rays;
            below += found.directions[i].y < 0;  // the camera is level
        }
        EXPECT_GT(rays, 500u);
        EXPECT_EQ(targets.contains(ray_below_horizon) ? targets.at(ray_below_horizon) : 0, below);
        if (draws == 0) {
            EXPECT_GT(below, rays / 10);
        } else {
            EXPECT_EQ(below, 0u);
        }
    }
}

/// A floor that an orthographic camera sees from one direction everywhere: one lobe, of which each pixel draws a ray.
struct FrostbiteDraws : FrostbiteRaysTest {
    LobeCase lobe;

    /// Deviation, in standard errors, of the mean of f(direction) / density over rays above the horizon from the
    /// integral of f over the directions above it that truncation leaves. f: `share` of the lobe's density q, which
    /// makes a mean of nearly equal numbers, of which only the density's own error can be off.
    template <class Share>
    double deviation(const Share& share) {
        const float down = glm::radians(90 - lobe.view_degrees);
        pose.world_from_view = glm::rotate(glm::translate(glm::mat4(1), {0, 5, 0}), -down, glm::vec3(1, 0, 0));
        const glm::mat3 view_from_world = glm::transpose(glm::mat3(pose.world_from_view));
        const glm::vec3 n = view_from_world * glm::vec3(0, 1, 0), x = glm::normalize(glm::vec3(0, 0, 1) - n * n.z);
        const glm::mat3 view_from_local(x, glm::cross(n, x), n);
        const LobeCase whole{lobe.lobe, lobe.roughness, lobe.view_degrees, 0};
        const glm::dvec3 o = lobe.o();
        const FrostbiteTraced found = trace([&](const CameraRay& ray) {
            return SyntheticHit{.distance = -ray.origin.y / ray.direction.y,
                                .normal = {0, 1, 0},
                                .roughness = lobe.roughness,
                                .metalness = 1,
                                .specular = 1};
        });
        double sum = 0, squares = 0, count = 0;
        for (size_t ray = 0; ray < found.directions.size(); ++ray) {
            if (!found.is_ray(ray)) continue;
            const glm::dvec3 i = glm::vec3(found.directions[ray]) * view_from_local, m = glm::normalize(o + i);
            // Mirroring: Walter et al. 2007, eq. 38.
            const double q = lobe_normal_density(whole, m) / (4 * std::abs(glm::dot(o, m)));
            const double value = i.z > 0 ? share(i) * q * double(found.directions[ray].w) : 0;
            sum += value, squares += value * value, ++count;
        }
        const double mean = sum / count, variance = squares / count - mean * mean;
        const double truth =
            (1 - lobe.bias) * mean_over_lobe(lobe, [&](glm::dvec3 i) { return i.z > 0 ? share(i) : 0.0; });
        const double of_integral = 0.002, of_table = 0.003;  // its edges; between texels, away from grazing views
        return std::max(std::abs(mean - truth) - of_integral - of_table, 0.0) / std::sqrt(variance / count);
    }
};

/// Up to 28 % of the draws go below this floor's horizon. 5.3 standard deviations: a false alarm in 10^7 for each of
/// the 40 means, one in 2 * 10^5 for all.
TEST_F(FrostbiteDraws, ComeAboutWithTheDensityThatTheyCarry) {
    view.extent = {128, 128};
    pose = {.is_orthographic = true, .orthographic_height = 2};
    for (const unsigned kind : {lobe_of_normals, lobe_of_visible_normals})
        for (const float angle : {60.0f, 75.0f})
            for (const float bias : {0.0f, 0.3f})
                for (const unsigned regenerations : {0u, 1u, 4u}) {
                    lobe = {kind, 0.6f, angle, bias};
                    parameters.params.assign({{"classification", false},
                                              {"half_resolution", false},
                                              {"lobe", kind == lobe_of_normals ? "normals" : "visible_normals"},
                                              {"importance_bias", bias},
                                              {"max_regenerations", regenerations},
                                              {"max_roughness", 1.0}});
                    SCOPED_TRACE(testing::Message() << name_of(lobe) << ", drawn again " << regenerations << " times");
                    EXPECT_LT(deviation([](glm::dvec3) { return 1.0; }), 5.3);
                    if (regenerations == 1) continue;
                    EXPECT_LT(deviation([](glm::dvec3 i) { return i.x < -0.5 ? 1.0 : 0.1; }), 5.3);
                }
}

TEST_F(FrostbiteRaysTest, AreNotMarchedIntoTheGeometricSurface) {
    parameters.params.assign({{"classification", false}});
    camera = camera_data(pose, nullptr, view);
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, bare_floor(0.3f));
    HostImage tilted(view.extent, 4);
    const glm::vec3 shading = glm::normalize(glm::vec3(1, 1, 0));
    for (size_t i = 0; i < tilted.pixel_count(); ++i) {
        tilted.set_rgb(i, shading);
        tilted.values[4 * i + 3] = 0.3f;
    }
    pass_list.upload(gbuffer.normal, tilted);
    pass_list.begin_frame(camera, parameters.params, gbuffer.images());
    const FrostbiteTraced found = trace_frostbite(pass_list, gbuffer, parameters);
    size_t into = 0, out = 0;
    for (size_t i = 0; i < found.directions.size(); ++i) {
        if (!found.is_ray(i)) continue;
        const bool is_into = found.directions[i].y <= 0;
        if (found.hits[i].x == ray_below_horizon) continue;
        EXPECT_EQ(found.hits[i].x == ray_into_surface, is_into);
        ++(is_into ? into : out);
    }
    EXPECT_GT(into, 100u);
    EXPECT_GT(out, 100u);
}

/// A mirror at the left, turned by 45 degrees, sends its rays behind a panel that faces the camera.
SyntheticHit mirror_and_panel(const CameraRay& ray) {
    const glm::vec3 on_panel = ray.origin - 8.9f / ray.direction.z * ray.direction;
    if (std::abs(on_panel.x - 0.25f) < 0.75f && std::abs(on_panel.y) < 1)
        return {.distance = glm::length(on_panel), .normal = {0, 0, 1}};
    const glm::vec3 on_mirror = ray.origin - 13 / (ray.direction.x + ray.direction.z) * ray.direction;
    if (on_mirror.x > -1.5f || on_mirror.x < -9) return {};
    return {.distance = glm::length(on_mirror),
            .normal = glm::normalize(glm::vec3(1, 0, 1)),
            .roughness = 0.05f,
            .metalness = 1,
            .specular = 1};
}

TEST_F(FrostbiteRaysTest, MissWhatTheyMeetFromBehind) {
    for (const float rough_from : {0.0f, 1.0f}) {
        parameters.params.assign({{"classification", false},
                                  {"half_resolution", false},
                                  {"rough_from", rough_from},
                                  {"frostbite.relative_thickness", 1.0}});
        const FrostbiteTraced found = trace(mirror_and_panel);
        parameters.params.assign({{"frostbite.front_faces_only", false}});
        const FrostbiteTraced unchecked = trace(mirror_and_panel);
        size_t from_behind = 0;
        for (size_t i = 0; i < found.directions.size(); ++i) {
            if (!found.is_ray(i) || !unchecked.is_hit(i)) continue;
            const glm::vec3 normal = seen(mirror_and_panel, glm::uvec2(unchecked.hit_pixel(i))).normal;
            const bool is_behind = glm::dot(glm::vec3(found.directions[i]), normal) > 0;
            EXPECT_EQ(found.hits[i].x, is_behind ? ray_missed : unchecked.hits[i].x);
            from_behind += is_behind;
        }
        EXPECT_GT(from_behind, 50u);
        parameters.params.assign({{"frostbite.front_faces_only", true}});
    }
}

/// A bare floor at a grazing angle: all that a ray could meet is the floor itself. Both tracers.
TEST_F(FrostbiteRaysTest, DoNotMeetThePlaneThatTheyLeave) {
    pose.vertical_fov = 0.3f;
    for (const bool leaves : {true, false})
        for (const float rough_from : {0.0f, 1.0f}) {
            parameters.params.assign({{"classification", false},
                                      {"half_resolution", false},
                                      {"rough_from", rough_from},
                                      {"frostbite.front_faces_only", false},
                                      {"frostbite.leave_own_plane", leaves}});
            const auto targets = count_targets(trace(bare_floor(0.5f)));
            const size_t hits = targets.contains(0) ? targets.at(0) : 0;
            EXPECT_GT(targets.at(ray_missed), 1000u);
            EXPECT_EQ(hits == 0, leaves) << hits << ", rough from " << rough_from;
        }
}

}  // namespace
