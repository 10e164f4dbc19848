#pragma once
#include "tests/variants/brute_force_hierarchy.h"
#include "tests/variants/diligent_trace.h"

#include <glm/gtc/matrix_transform.hpp>
#include <optional>

// A mirror floor before a wall, whose reflections are known in closed form.

/// The scene `scale` times as large.
inline SyntheticScene scaled(float scale) {
    return [=](const CameraRay& ray) {
        SyntheticHit hit = floor_before_white({ray.origin / scale, ray.direction});
        hit.distance *= scale;
        return hit;
    };
}

/// The mirror ray of a floor pixel: where it meets the wall's plane on the screen of the images (pixels), and its
/// length.
struct Mirrored {
    glm::vec2 pixel;
    float distance;
};

/// What is left of hits near the border of the screen: DiligentFX fades them out over 5 % of its height.
inline float fade_at(glm::vec2 uv, glm::vec2 extent) {
    const glm::vec2 width = 0.05f * glm::vec2(extent.y / extent.x, 1);
    const glm::vec2 fade =
        glm::smoothstep(glm::vec2(0), width, uv) * (1.0f - glm::smoothstep(1.0f - width, glm::vec2(1), uv));
    return fade.x * fade.y;
}

struct DiligentHits : DiligentTracing {
    DiligentHits() {
        // Rolled a little, so that rows of pixels do not meet rows of what they reflect.
        pose.world_from_view = glm::rotate(glm::mat4(1), 0.07f, glm::vec3(0.3f, 0, 1));
        view.extent = {160, 120};
        noise = HostImage({128, 128}, 2, 0.0f);
    }

    /// `scale`: of the scene. Nothing for pixels that show no floor, or of it the last half metre before the wall.
    std::optional<Mirrored> mirrored(unsigned x, unsigned y, float scale = 1) const {
        const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(x, y) + 0.5f + view.jitter);
        const SyntheticHit first = mirror_floor(ray);
        const glm::vec3 p = ray.origin + first.distance * ray.direction, d = ray.direction * glm::vec3(1, -1, 1);
        if (first.metalness == 0 || p.z < -5.5f) return std::nullopt;
        const float length = (-6 - p.z) / d.z;
        const CameraData data = camera();
        const glm::dvec3 on_screen = screen_point(data, data.view_from_world * glm::vec4(scale * (p + length * d), 1));
        return Mirrored{glm::vec2(on_screen) - view.jitter, scale * length};
    }

    /// Shares of the floor's pixels whose ray ends on the screen.
    struct Quality {
        unsigned rays = 0;
        double hits = 0;   ///< that have a confidence above 0
        double right = 0;  ///< and show the right pixel or one beside it
    };
    Quality quality(const nlohmann::json& parameters, float scale = 1) {
        HostGBuffer gbuffer = gbuffer_of(scaled(scale));
        encode_hits(gbuffer);
        const HostImage found = trace(gbuffer, parameters).radiance;
        Quality quality;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const std::optional<Mirrored> expected = mirrored(x, y, scale);
                const glm::vec2 extent(view.extent);
                if (!expected || fade_at(expected->pixel / extent, extent) < 1) continue;
                const float* ours = found.pixel(x, y);
                const glm::vec2 apart = glm::abs(glm::vec2(ours[0], ours[1]) * extent - expected->pixel);
                ++quality.rays;
                quality.hits += ours[3] > 0;
                quality.right += ours[3] > 0 && glm::all(glm::lessThan(apart, glm::vec2(1.5f)));
            }
        quality.hits /= quality.rays;
        quality.right /= quality.rays;
        return quality;
    }

    void enlarge(float scale) {
        pose.near *= scale;
        pose.far *= scale;
    }
};
