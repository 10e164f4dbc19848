// Frostbite's hits on what the previous frame did not show.
#include "core/gbuffer/environment_images.h"
#include "tests/variants/frostbite_bench.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace {

constexpr glm::uvec2 extent{96, 64};
constexpr glm::vec3 post_color{1, 0, 0}, wall_color{0, 1, 0}, environment_color{0, 0, 1};

/// An endlessly high post before a wall. Its right side is only seen from the right.
SyntheticHit post_and_wall(const CameraRay& ray) {
    const auto distance_to = [&](int axis, float plane) { return (plane - ray.origin[axis]) / ray.direction[axis]; };
    const auto is_between = [&](int axis, float distance, float low, float high) {
        const float at = ray.origin[axis] + distance * ray.direction[axis];
        return at > low && at < high;
    };
    SyntheticHit hit{.roughness = 0.3f, .metalness = 1, .specular = 1};
    const float front = distance_to(2, -3.5f), side = distance_to(0, 0.5f);
    if (is_between(0, front, -0.5f, 0.5f)) {
        hit.distance = front;
        hit.lit = post_color;
    } else if (ray.direction.x < 0 && is_between(2, side, -4.5f, -3.5f)) {
        hit.distance = side;
        hit.normal = {1, 0, 0};
        hit.lit = post_color;
    } else {
        hit.distance = distance_to(2, -8);
        hit.lit = wall_color;
    }
    return hit;
}

/// The pixel of a ray's hit.
unsigned hit_pixel(const StoredRay& ray) { return (ray.target >> 16) * extent.x + (ray.target & 0xffff); }

struct FrostbiteHiddenHits : TechniqueTest {
    CameraPose before{.vertical_fov = 0.9f, .orthographic_height = 6}, now = before;
    FrameView view{.extent = extent, .jitter = {0.3f, -0.2f}, .previous_jitter = {-0.4f, 0.1f}};
    std::mt19937 random{3};

    CameraRay ray_now(unsigned pixel) const {
        return camera_ray(now, extent, glm::vec2(pixel % extent.x, pixel / extent.x) + 0.5f + view.jitter);
    }
    SyntheticHit shown_before(glm::vec2 place) const {
        return post_and_wall(camera_ray(before, extent, place + view.previous_jitter));
    }

    HostImage lit_before() const {
        HostImage lit(extent, 4);
        for (unsigned i = 0; i < lit.pixel_count(); ++i)
            lit.set_rgb(i, shown_before(glm::vec2(i % extent.x, i / extent.x) + 0.5f).lit);
        return lit;
    }

    struct Hit {
        enum class Kind { seen, hidden, left_screen, close_call } kind;
        glm::vec3 color{0};  ///< of the previous image where the hit was
    };

    /// `margin`: pixels around its place in the previous image that must not show anything else.
    Hit hit_at(const FrostbiteBench& bench, unsigned pixel, float margin) const {
        const CameraRay ray = ray_now(pixel);
        const SyntheticHit shown = post_and_wall(ray);
        const glm::vec3 point = ray.origin + shown.distance * ray.direction;
        const glm::vec4 clip = bench.camera.previous_clip_from_world * glm::vec4(point, 1);
        const glm::vec2 size(extent), place = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size - view.previous_jitter,
                                      inside = glm::min(place, size - place);
        const float to_border = std::min(inside.x, inside.y);
        if (to_border < -1e-3f) return {Hit::Kind::left_screen};
        if (to_border < margin) return {Hit::Kind::close_call};
        const SyntheticHit at = shown_before(place);
        for (const float side : {-margin, margin}) {
            const SyntheticHit beside = shown_before(place + glm::vec2(side, 0));
            if (beside.lit != at.lit || beside.normal != at.normal) return {Hit::Kind::close_call};
        }
        const bool is_same = at.lit == shown.lit && at.normal == shown.normal;
        return {is_same ? Hit::Kind::seen : Hit::Kind::hidden, at.lit};
    }

    /// Two rays of each pixel that weigh the same and hit any two pixels.
    std::vector<StoredRay> pairs_of_rays(const FrostbiteBench& bench, float length) {
        std::vector<StoredRay> rays;
        for (unsigned i = 0; i < extent.x * extent.y; ++i) {
            const CameraRay ray = ray_now(i);
            const glm::vec3 mirrored = glm::reflect(ray.direction, post_and_wall(ray).normal);
            for (int k = 0; k < 2; ++k)
                rays.push_back({.direction = glm::mat3(bench.camera.view_from_world) * mirrored,
                                .inverse_density = 1,
                                .target = unsigned(random() % extent.x) | unsigned(random() % extent.y) << 16,
                                .length = length});
        }
        return rays;
    }

    /// Colour times confidence, and confidence.
    static glm::vec4 expected(const std::array<Hit, 2>& hits, const nlohmann::json& rule) {
        glm::vec4 sum(0);
        float count = 0;
        for (const Hit& hit : hits) {
            const bool is_hidden = hit.kind == Hit::Kind::hidden;
            if (is_hidden && rule["hidden_hits"] == "drop") continue;
            ++count;
            if (hit.kind == Hit::Kind::seen || (is_hidden && rule["hidden_hits"] == "show"))
                sum += glm::vec4(hit.color, 1);
            else if (rule["misses"] == "fallback")
                sum += glm::vec4(environment_color, 1);
        }
        return count > 0 ? sum / count : glm::vec4(0);
    }

    /// `length`: of rays, from which follow levels up to one whose footprint reaches `margin` pixels.
    void expect_rule(nlohmann::json rule, float length, float margin) {
        SCOPED_TRACE(testing::Message() << rule << " " << now.is_orthographic << int(view.depth_direction));
        nlohmann::json parameters = {
            {"taps", "1"}, {"half_resolution", false}, {"neighbor_ray", "direction"}, {"max_rays", 2}};
        parameters.update(rule);
        FrostbiteBench bench(device(), now, view, post_and_wall, parameters);
        const Environment blue{.color = environment_color};
        const EnvironmentImages environment(bench.pass_list, blue, false);
        bench.gbuffer.environment = &environment;
        bench.set_previous(before, post_and_wall);
        const std::vector<StoredRay> rays = pairs_of_rays(bench, length);
        const HostImage found = bench.resolve(rays, lit_before()).radiance;
        unsigned seen = 0, hidden = 0;
        for (unsigned i = 0; i < found.pixel_count(); ++i) {
            const bool is_far = post_and_wall(ray_now(i)).lit == wall_color;
            if (margin > 1 && !is_far) continue;  // hits nearer to the camera, with wider footprints
            const std::array<Hit, 2> hits{hit_at(bench, hit_pixel(rays[2 * i]), margin),
                                          hit_at(bench, hit_pixel(rays[2 * i + 1]), margin)};
            if (hits[0].kind == Hit::Kind::close_call || hits[1].kind == Hit::Kind::close_call) continue;
            seen += hits[0].kind == Hit::Kind::seen;
            hidden += hits[0].kind == Hit::Kind::hidden;
            const glm::vec4 pixel(found.rgb(i), found.values[4 * i + 3]), weighed = expected(hits, rule);
            // Filtering rounds places between equal texels; rays of equal weights differ by rounding.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c] * pixel.w, weighed[c], 1e-5f) << i;
            ASSERT_NEAR(pixel.w, weighed.w, 1e-5f) << i;
        }
        EXPECT_GT(seen, 500u);
        EXPECT_GT(hidden, 100u);
    }
};

TEST_F(FrostbiteHiddenHits, AreShownCountedOrLeftOut) {
    before.world_from_view = glm::rotate(glm::mat4(1), 0.05f, glm::vec3(0, 1, 0));
    const glm::mat4 to_the_right = glm::translate(glm::mat4(1), {1.4f, 0.1f, -0.3f});
    now.world_from_view = glm::rotate(to_the_right, 0.35f, glm::vec3(0, 1, 0));
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed})
        for (const bool is_orthographic : {false, true}) {
            view.depth_direction = direction;
            before.is_orthographic = now.is_orthographic = is_orthographic;
            for (const char* hidden_hits : {"show", "miss", "drop"})
                for (const char* misses : {"weight", "fallback"})
                    expect_rule({{"hidden_hits", hidden_hits}, {"misses", misses}, {"filtered_sampling", false}}, 1, 1);
            // A cone of up to 2 pixels' radius, from the first two levels. A texel of level 1 between two others, and
            // where it lies within them: 4 pixels.
            expect_rule({{"hidden_hits", "miss"}, {"misses", "weight"}, {"grazing_cone", "off"}, {"cone_scale", 0.6}},
                        2.2f, 4);
        }
}

SyntheticHit slope(const CameraRay& ray, glm::vec3 way) {
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 0, 1)), point = glm::vec3(0, 0, -6) + way;
    return {.distance = glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal),
            .normal = normal,
            .roughness = 0.3f,
            .metalness = 1,
            .specular = 1};
}

struct FrostbiteMovedHits : FrostbiteHiddenHits {
    /// 1 if the previous frame showed the middle of the image.
    double share_seen(const SyntheticScene& scene_before, const SyntheticScene& scene, glm::vec3 way) {
        const nlohmann::json parameters = {{"taps", "1"}, {"half_resolution", false}, {"hidden_hits", "miss"}};
        FrostbiteBench bench(device(), now, view, scene, parameters);
        bench.set_previous(before, scene_before, way);
        std::vector<StoredRay> rays(extent.x * extent.y);
        for (StoredRay& ray : rays)
            ray = {.direction = glm::normalize(glm::vec3(1, 0, 0.2f)),
                   .inverse_density = 1,
                   .target = extent.x / 2 | extent.y / 2 << 16,
                   .length = 1};
        const HostImage found = bench.resolve(rays, HostImage(extent, 4, 1.0f)).radiance;
        double sum = 0;
        for (size_t i = 0; i < found.pixel_count(); ++i) sum += found.values[4 * i + 3];
        return sum / double(found.pixel_count());
    }
    double share_seen_of_slope(glm::vec3 way) {
        return share_seen([](const CameraRay& ray) { return slope(ray, glm::vec3(0)); },
                          [&](const CameraRay& ray) { return slope(ray, way); }, way);
    }
};

/// Along the screen by 6 pixels, which would be 6 % off the plane had it stood still; towards the camera by less and by
/// more than the limit.
TEST_F(FrostbiteMovedHits, AreSeenIfTheyKeepTheirDistance) {
    EXPECT_EQ(share_seen_of_slope({0, 0, 0}), 1);
    EXPECT_EQ(share_seen_of_slope({0.55f, 0, 0}), 1);
    EXPECT_EQ(share_seen_of_slope({0, 0, 0.05f}), 1);
    EXPECT_EQ(share_seen_of_slope({0, 0, 0.15f}), 0);
    EXPECT_EQ(share_seen_of_slope({0, 0, -0.15f}), 0);
    // Wherever the camera looked.
    for (const float turn : {-0.3f, 0.3f}) {
        before.world_from_view = glm::rotate(glm::mat4(1), turn, glm::vec3(0, 1, 0));
        for (const float side : {-1.0f, 1.0f}) {
            EXPECT_EQ(share_seen_of_slope(side * glm::vec3(0, 0, 0.07f)), 1) << turn << side;
            EXPECT_EQ(share_seen_of_slope(side * glm::vec3(0, 0, 0.1f)), 0) << turn << side;
        }
    }
}

TEST_F(FrostbiteMovedHits, AreNotSeenWhereNothingWasDrawn) {
    before.far = now.far = 6.03f;  // as near as the slope
    const SyntheticScene nothing = [](const CameraRay&) { return SyntheticHit{}; };
    EXPECT_EQ(share_seen(
                  nothing, [](const CameraRay& ray) { return slope(ray, glm::vec3(0)); }, glm::vec3(0)),
              0);
}

}  // namespace
