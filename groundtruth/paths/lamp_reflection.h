#pragma once
#include "groundtruth/paths/traced_scene.h"

/// A point that reflects, as shading has it.
struct ReflectingPoint {
    vec3 position;           ///< m, where the light arrives
    vec3 ray_origin, error;  ///< of shadow rays, see aim_shadow_ray() (m)
    vec3 geometric_normal;   ///< unit, on the viewer's side
};

/// Radiance (W sr^-1 m^-2) of a punctual light that a point reflects specularly, in closed form but for its visibility.
/// `lobes` have their local frame `world_from_local`.
vec3 specular_reflection(const TracedScene& scene, const PunctualLight& light, const ReflectingPoint& point,
                         const Lobes& lobes, const mat3& world_from_local, PixelEstimate& estimate);

/// The part of the promised LightLanes::radiance of a mirrored lamp that arrives, by channel.
glm::vec3 mirrored_part(const TracedScene& scene, const LightLanes& lights, int lane, uint32_t image,
                        PixelEstimate& estimate);

/// The part of LightLanes::radiance that arrives: 1 or 0, but for mirrored lamps. `reflections`: of the path, with the
/// one where the light arrives.
inline glm::vec3 arriving(const TracedScene& scene, const LightLanes& lights, int lane, unsigned reflections,
                          PixelEstimate& estimate) {
    const uint32_t image = scene.lights.image(lights.group[lane]);
    if (image != MirroredLamps::none) [[unlikely]]
        return reflections < scene.settings.max_depth ? mirrored_part(scene, lights, lane, image, estimate)
                                                      : glm::vec3(0.0f);
    return glm::vec3(is_visible(scene, lights, lane, estimate) ? 1.0f : 0.0f);
}
