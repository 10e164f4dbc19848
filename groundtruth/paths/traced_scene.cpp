#include "groundtruth/paths/traced_scene.h"

#include <algorithm>

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
