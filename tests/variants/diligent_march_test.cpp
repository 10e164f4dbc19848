// Where rays end, against a march through every pixel.
#include "tests/variants/brute_force_hierarchy.h"
#include "tests/variants/diligent_trace.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace {

/// Hills with posts before them and holes of background, all mirrors that send their rays in all directions.
SyntheticHit uneven_mirrors(const CameraRay& ray) {
    const glm::vec3 d = ray.direction / -ray.direction.z;  // one metre along the axis
    if (std::sin(17 * d.x) * std::sin(13 * d.y) > 0.9f) return {};
    const bool is_post = std::fmod(d.x + 10, 0.45f) < 0.06f;
    const float depth = is_post ? 3 : 6 + 1.5f * std::sin(5 * d.x) * std::cos(4 * d.y);
    const glm::vec3 normal(std::sin(23 * d.x + 3 * d.y), std::cos(19 * d.y), 0.6f);
    return {.distance = depth * glm::length(d),
            .normal = glm::normalize(normal),
            .roughness = 0,
            .metalness = 1,
            .specular = 1};
}

/// What became of the rays that travel two pixels or more, as shares of them.
struct Outcome {
    size_t rays = 0;
    double on_screen = 0, wrong = 0;
};

struct DiligentMarch : DiligentTracing {
    const nlohmann::json corrected = {{"hierarchy.clip_ray_to_near_plane", true},
                                      {"hierarchy.relative_ray_step", true},
                                      {"hierarchy.max_traversal_intersections", 4096},
                                      {"hierarchy.stop_outside_screen", true}};

    /// Rays that leave the screen end at the next border of the level that they are on.
    static bool is_same(const BruteForceEnd& expected, double length, glm::dvec2 pixels_apart) {
        if (!expected.is_on_screen) return length > 0.99 * expected.distance;
        // The original oversteps each border by 0.005 pixels along the axis that crosses it.
        return glm::min(std::abs(pixels_apart.x), std::abs(pixels_apart.y)) < 0.01 &&
               std::abs(length - expected.distance) < 0.02 * expected.distance;
    }

    Outcome compare(nlohmann::json parameters) {
        parameters.update(corrected);
        const HostGBuffer gbuffer = gbuffer_of(uneven_mirrors);
        const HostImage found = trace(gbuffer, parameters).direction;
        Outcome outcome;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const glm::dvec3 ray =
                    glm::dmat3(gbuffer.camera.view_from_world) * glm::dvec3(found.rgb(size_t(y) * view.extent.x + x));
                const double length = glm::length(ray);
                if (length == 0) continue;
                const BruteForceEnd expected = brute_force_end(gbuffer.depth, gbuffer.camera, {x, y}, ray / length);
                const glm::dvec3 origin = view_point(gbuffer.depth, gbuffer.camera, {x, y});
                const glm::dvec2 end = screen_point(gbuffer.camera, origin + ray),
                                 expected_end = screen_point(gbuffer.camera, origin + ray / length * expected.distance);
                if (glm::distance(expected_end, glm::dvec2(x, y) + 0.5) < 2) continue;
                ++outcome.rays;
                outcome.on_screen += expected.is_on_screen;
                outcome.wrong += !is_same(expected, length, end - expected_end);
            }
        outcome.on_screen /= double(outcome.rays);
        outcome.wrong /= double(outcome.rays);
        return outcome;
    }
};

}  // namespace

/// Where a ray meets a surface and the border of a pixel at once, or passes a corner, float32 decides otherwise in
/// places.
constexpr double near_ties = 0.005;

/// Sizes of which the coarser levels leave columns and rows over, and one that 64 divides.
TEST_F(DiligentMarch, PartialTexelsClampedEndRaysWhereAMarchThroughEveryPixelDoes) {
    for (const glm::uvec2 extent : {glm::uvec2(161, 93), glm::uvec2(128, 64), glm::uvec2(101, 127)})
        for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
            SCOPED_TRACE(testing::Message()
                         << extent.x << "x" << extent.y << ", reversed " << (direction == DepthDirection::reversed));
            view.extent = extent;
            view.depth_direction = direction;
            const Outcome found = compare({{"hierarchy.partial_texels", "clamped"}});
            EXPECT_GT(found.rays, 1500u);
            EXPECT_GT(found.on_screen, 0.5);
            EXPECT_LT(found.wrong, near_ties);
        }
}

/// The texels that the original misses are near ones with standard depth, which only costs steps, but far ones with
/// reversed depth, which rays pass below.
TEST_F(DiligentMarch, PartialTexelsOfZeroAreLostWithReversedDepth) {
    view.extent = {161, 93};
    EXPECT_LT(compare({{"hierarchy.partial_texels", "zero"}}).wrong, near_ties);
    view.depth_direction = DepthDirection::reversed;
    EXPECT_GT(compare({{"hierarchy.partial_texels", "zero"}}).wrong, 0.03);
}

/// A floor that fills the image, whose rays leave upwards. 64 divides the height, so that all levels have a border at
/// the top, which rays overstep by 0.005 pixels. In reversed depth what lies off the screen is far away, and the
/// original goes on until its steps are used up.
TEST_F(DiligentMarch, StopOutsideScreenEndsRaysAtTheBorder) {
    view = {.extent = {64, 128}, .depth_direction = DepthDirection::reversed};
    pose.world_from_view = glm::rotate(glm::mat4(1), -0.85f, glm::vec3(1, 0, 0));
    const HostGBuffer gbuffer = gbuffer_of(floor_below_nothing);
    const auto mean_height = [&](bool stops) {
        const HostImage found =
            trace(gbuffer, {{"hierarchy.stop_outside_screen", stops}, {"hierarchy.clip_ray_to_near_plane", true}})
                .direction;
        double sum = 0;
        for (unsigned y = 0; y < view.extent.y; ++y) {
            const glm::dvec3 ray =
                glm::dmat3(gbuffer.camera.view_from_world) * glm::dvec3(found.rgb(size_t(y) * view.extent.x + 31));
            sum += screen_point(gbuffer.camera, view_point(gbuffer.depth, gbuffer.camera, {31, y}) + ray).y;
        }
        return sum / view.extent.y;
    };
    EXPECT_NEAR(mean_height(true), -0.005, 0.002);
    EXPECT_LT(mean_height(false), -10);
}
