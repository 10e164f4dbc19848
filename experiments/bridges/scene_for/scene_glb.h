#pragma once
#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

/// One name for each of scene.instances, of letters, digits and '_' alone, which no engine's importer changes: the
/// node's, with a number where several would have it.
std::vector<std::string> instance_names(const Scene& scene);

/// A camera as it stands in one frame.
struct GlbCamera {
    SceneCamera lens;
    glm::mat4 world_from_camera{1.0f};
    float aspect = 1.0f;  ///< width over height
};

/// Writes what the scene draws as one binary glTF: a node for each instance (instance_names()), without parents and
/// posed as in `pose`, with joints and morph targets applied, materials with their textures as PNG, punctual lights,
/// and cameras. What scene.json overrides is in it. Loading it gives the same triangles, materials and matrices to the
/// bit, but for normals (made of unit length again), emission (a factor times a strength), reflectances of dielectrics
/// (an index of refraction) and for transforms of textures (an angle and scales), which may differ by rounding; and all
/// materials are double-sided, as ssrlab draws them, which in ssrlab also says that backs emit. Fails as
/// GlbFile::write().
void write_scene_glb(const std::filesystem::path& file, const Scene& scene, const ScenePose& pose,
                     const std::vector<GlbCamera>& cameras);
