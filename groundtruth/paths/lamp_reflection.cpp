#include "groundtruth/paths/lamp_reflection.h"

#include <cmath>

namespace {

/// The light of a lamp that its mirror reflects along the ray of a lane (W sr^-1 m^-2).
vec3 mirrored_radiance(const TracedScene& scene, const LightLanes& lights, int lane, uint32_t image,
                       PixelEstimate& estimate) {
    const vec3 direction = lights.shadow_direction.get(lane);
    RTCRayHit ray;
    ++estimate.rays;
    if (!intersect(scene.geometry.handle(), lights.shadow_origin.get(lane), direction, ray)) return vec3(0.0f);
    const MirroredLamps& mirrored = scene.lights.mirrored_lamps();
    const uint32_t instance = ray.hit.instID[0], triangle = ray.hit.primID;
    if (mirrored.mirror(instance, triangle) != mirrored.mirror_of(image)) return vec3(0.0f);
    const PunctualLight& lamp = scene.lights.punctual_lights()[mirrored.lamp(image)];
    vec3 reflected(0.0f);
    const auto take = [&](const ShadedPoint& surface) {
        const mat3 world_from_local = basis_from_normal(unit_normal(surface.normal, surface.geometric_normal));
        const vec3 o = -direction * world_from_local;
        if (!(o.z > 0.0f)) return;
        const Lobes lobes = scene.materials.any_dielectric_f0()
                                ? make_lobes(surface.base_color, surface.metalness, surface.roughness, surface.specular,
                                             surface.dielectric_f0, o, scene.settings.model)
                                : make_lobes(surface.base_color, surface.metalness, surface.roughness, surface.specular,
                                             o, scene.settings.model);
        reflected =
            specular_reflection(scene, lamp, {surface.origin, surface.origin, surface.error, surface.geometric_normal},
                                lobes, world_from_local, estimate);
    };
    scene.materials.shade(instance, triangle, ray.hit.u, ray.hit.v, -direction, ray.ray.tfar, take);
    return reflected;
}

}  // namespace

vec3 specular_reflection(const TracedScene& scene, const PunctualLight& light, const ReflectingPoint& point,
                         const Lobes& lobes, const mat3& world_from_local, PixelEstimate& estimate) {
    const PunctualArrival arriving = arrival(light, point.position);
    const vec3 f = evaluate(lobes, arriving.direction * world_from_local).specular;
    const vec3 reflected = f * arriving.irradiance;
    if (!(dot(arriving.direction, point.geometric_normal) > 0) || reflected == vec3(0.0f)) return vec3(0.0f);
    LightLanes shadow;
    shadow.direction.set(0, arriving.direction);
    shadow.position.set(0, light.position);
    shadow.is_infinite[0] = arriving.is_infinite;
    aim_shadow_ray(point.ray_origin, point.error, point.geometric_normal, 0, shadow);
    return is_visible(scene, shadow, 0, estimate) ? reflected : vec3(0.0f);
}

glm::vec3 mirrored_part(const TracedScene& scene, const LightLanes& lights, int lane, uint32_t image,
                        PixelEstimate& estimate) {
    const vec3 part = mirrored_radiance(scene, lights, lane, image, estimate) / lights.radiance.get(lane).x;
    const bool is_finite = std::isfinite(part.x + part.y + part.z);
    estimate.non_finite += !is_finite;
    return is_finite ? part : vec3(0.0f);
}
