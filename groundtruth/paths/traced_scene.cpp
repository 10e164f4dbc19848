#include "groundtruth/paths/traced_scene.h"

#include <algorithm>
#include <cmath>

namespace {

/// BSDF sampling alone finds an open sky, constant or a gradient, as well as a table would. A sky that walls hide
/// nearly everywhere it finds with more noise, but lamps then keep all light samples.
bool samples_environment(const Scene& scene, LightStrategy strategy) {
    if (strategy == LightStrategy::bsdf_only) return false;
    return strategy == LightStrategy::light_only || scene.environment.type == Environment::Type::image;
}

/// Only beside BSDF sampling, which finds what other surfaces reflect.
bool samples_mirrors(const PathTracerSettings& settings) {
    return settings.mirrored_lamps &&
           (settings.strategy == LightStrategy::power || settings.strategy == LightStrategy::balance);
}

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
        const PunctualArrival arriving = arrival(lamp, surface.origin);
        const mat3 world_from_local = basis_from_normal(unit_normal(surface.normal, surface.geometric_normal));
        const vec3 o = -direction * world_from_local;
        if (!(o.z > 0.0f) || !(dot(arriving.direction, surface.geometric_normal) > 0)) return;
        const Lobes lobes = scene.materials.any_dielectric_f0()
                                ? make_lobes(surface.base_color, surface.metalness, surface.roughness, surface.specular,
                                             surface.dielectric_f0, o, scene.settings.model)
                                : make_lobes(surface.base_color, surface.metalness, surface.roughness, surface.specular,
                                             o, scene.settings.model);
        reflected = evaluate(lobes, arriving.direction * world_from_local).specular * arriving.irradiance;
        if (reflected == vec3(0.0f)) return;
        LightLanes shadow;
        shadow.direction.set(0, arriving.direction);
        shadow.position.set(0, lamp.position);
        shadow.is_infinite[0] = arriving.is_infinite;
        aim_shadow_ray(surface.origin, surface.error, surface.geometric_normal, 0, shadow);
        if (!is_visible(scene, shadow, 0, estimate)) reflected = vec3(0.0f);
    };
    scene.materials.shade(instance, triangle, ray.hit.u, ray.hit.v, -direction, ray.ray.tfar, take);
    return reflected;
}

}  // namespace

TracedScene::TracedScene(const Scene& scene, const ScenePose& pose, const CameraView& camera,
                         const PathTracerSettings& settings)
    : scene(scene),
      camera(camera),
      settings(settings),
      mis(settings.strategy),
      geometry(scene, pose, settings.keep_all),
      materials(scene, geometry, settings.keep_all),
      lights(scene, pose, geometry, materials, samples_environment(scene, settings.strategy),
             settings.strategy != LightStrategy::light_only, samples_mirrors(settings)),
      has_environment(settings.keep_all || !scene.environment.is_black()) {}

glm::vec3 mirrored_part(const TracedScene& scene, const LightLanes& lights, int lane, uint32_t image,
                        PixelEstimate& estimate) {
    const vec3 part = mirrored_radiance(scene, lights, lane, image, estimate) / lights.radiance.get(lane).x;
    const bool is_finite = std::isfinite(part.x + part.y + part.z);
    estimate.non_finite += !is_finite;
    return is_finite ? part : vec3(0.0f);
}

bool is_on_screen(const TracedScene& scene, glm::vec3 position, glm::vec3 error, glm::vec3 normal,
                  PixelEstimate& estimate) {
    const glm::vec3 to_eye = scene.camera.to_eye(position);
    if (glm::dot(normal, to_eye) <= 0 || !scene.camera.frames(position)) return false;
    ++estimate.rays;
    return !is_hidden_from_camera(scene.geometry.handle(), scene.camera, position, error, normal);
}

bool is_on_screen(const TracedScene& scene, glm::vec3 direction, PixelEstimate& estimate) {
    if (!scene.camera.frames_direction(direction)) return false;
    ++estimate.rays;
    const float cosine = scene.camera.cosine(direction);
    return !is_occluded(scene.geometry.handle(), scene.camera.eye(), direction, scene.camera.far() / cosine,
                        scene.camera.near() / cosine);
}

std::vector<LeftOut> left_out_features(const TracedScene& traced) {
    std::vector<LeftOut> features;
    if (traced.settings.keep_all) return features;
    const Scene& scene = traced.scene;
    const auto reflects = [](const Material& material) {
        return !material.is_unlit && (material.metalness > 0 || (material.specular > 0 && material.metalness < 1));
    };
    if (!traced.geometry.has_alpha_tests())
        features.push_back({"alpha tests", "no alpha masks",
                            "Embree calls no intersection filter, so that every ray stays in its own code.", "",
                            false});
    if (!traced.geometry.hides_backs())
        features.push_back({"back-face tests", scene.draws_backs ? "backs are drawn" : "all surfaces are double-sided",
                            "Every surface that a ray meets is seen.", "", false});
    if (!traced.materials.any_varies())
        features.push_back({"texture lookups", "no textures", "Each material is one set of constants."});
    if (traced.lights.empty())
        features.push_back({"light samples and shadow rays", "no emitters and no punctual lights",
                            "All light comes from the environment, which the paths find themselves."});
    if (!traced.lights.has_environment_table())
        features.push_back({"environment importance table", "no environment image",
                            "Sampling the lobes finds an open sky, constant or a gradient, as well as a table would."});
    if (!traced.has_environment)
        features.push_back({"environment lookups", "black environment", "A path that leaves the scene adds nothing."});
    if (std::ranges::none_of(scene.materials, reflects))
        features.push_back({"specular paths", "nothing reflective", "No lobe of any surface has anything to reflect."});
    return features;
}
