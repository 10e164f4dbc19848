// What half a pixel of jitter costs the reflection of a mirror floor, by the size of the scene: the figures of
// variants/diligent_ssr/document.md.
#include "tests/variants/diligent_hits.h"

#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>

namespace {

/// mirror_floor before a wall in waves of 2 m between 0.25 and 1; `scale` times as large.
float waves(glm::vec2 on_wall) {
    return 0.625f + 0.375f * std::sin(glm::pi<float>() * on_wall.x) * std::sin(glm::pi<float>() * on_wall.y);
}
SyntheticScene wavy(float scale) {
    return [=](const CameraRay& ray) {
        SyntheticHit hit = floor_before_white({ray.origin / scale, ray.direction});
        if (hit.metalness == 0)
            hit.lit = glm::vec3(waves(glm::vec2(ray.origin / scale + hit.distance * ray.direction)));
        hit.distance *= scale;
        return hit;
    };
}

/// Of the floor's pixels whose mirror ray ends on the screen, away from its border.
struct Cost {
    double rmse = 0, lost = 0,
           shifted = 0;  ///< shares of the pixels: no hit; one more than 1.5 pixels away along x or y
};

struct DiligentJitter : DiligentHits {
    DiligentJitter() { view.extent = {320, 180}; }

    /// Reflections before black against the exact ones.
    double rmse(const HostImage& shown, float scale) const {
        double squares = 0;
        unsigned count = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const std::optional<Mirrored> expected = mirrored(x, y, scale);
                const glm::vec2 size(view.extent);
                if (!expected || fade_at(expected->pixel / size, size) < 1) continue;
                const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(x, y) + 0.5f + view.jitter);
                const glm::vec3 floor = ray.direction * (-1 / ray.direction.y),
                                wall = floor + ray.direction * glm::vec3(1, -1, 1) * (expected->distance / scale);
                const float *found = shown.pixel(x, y), error = found[3] * found[0] - waves(glm::vec2(wall));
                squares += double(error) * error;
                ++count;
            }
        return std::sqrt(squares / count);
    }

    Cost cost(float scale, glm::vec2 jitter, bool is_undone) {
        const CameraPose small = pose;
        enlarge(scale);
        view.jitter = jitter;
        const nlohmann::json parameters = {{"hierarchy.unproject_jitter", is_undone}};
        const Quality hits = quality(parameters, scale);
        const double error = rmse(trace(gbuffer_of(wavy(scale)), parameters).radiance, scale);
        pose = small;
        return {.rmse = error, .lost = 1 - hits.hits, .shifted = hits.hits - hits.right};
    }
};

TEST_F(DiligentJitter, CostsTheMoreTheLargerTheSceneUnlessUndone) {
    const glm::vec2 half_a_pixel(0.5f, -0.5f);
    std::printf("scene       unproject_jitter  RMSE   lost hits  shifted hits\n");
    double before = 0;
    for (const float scale : {1.0f, 10.0f, 100.0f}) {
        const Cost still = cost(scale, {}, false), original = cost(scale, half_a_pixel, false),
                   corrected = cost(scale, half_a_pixel, true);
        const auto print = [&](const char* name, const Cost& of) {
            std::printf("x %-8g  %-16s  %.3f  %.4f     %.4f\n", double(scale), name, of.rmse, of.lost, of.shifted);
        };
        print("no jitter", still), print("false", original), print("true", corrected);
        // Rays end in other places within pixels.
        EXPECT_NEAR(corrected.rmse, still.rmse, 0.1 * still.rmse) << scale;
        EXPECT_LT(corrected.lost + corrected.shifted, 0.005) << scale;
        EXPECT_GT(original.rmse, 2 * still.rmse) << scale;
        EXPECT_GT(original.rmse, before) << scale;
        before = original.rmse;
    }
    EXPECT_GT(cost(100, half_a_pixel, false).lost, 0.99);
}

}  // namespace
