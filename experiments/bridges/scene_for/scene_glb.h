#pragma once
#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

/// A unique name for each of scene.instances: the node's name, with a number if several have it. Names have only
/// letters, digits and '_', which no engine's importer changes.
std::vector<std::string> instance_names(const Scene& scene);

/// A camera posed in one frame.
struct GlbCamera {
    SceneCamera lens;
    glm::mat4 world_from_camera{1.0f};
    float aspect = 1.0f;  ///< width over height
};

/// Writes what the scene draws as one binary glTF, with the overrides of scene.json:
///
/// - a node without parents for each instance (instance_names()), posed as in `pose`, with joints and morph targets
///   applied
/// - materials, with textures as PNG, all double-sided, as ssrlab draws them; in ssrlab this also means that backs emit
/// - punctual lights and cameras
///
/// Loading the file gives the same triangles, materials and matrices to the bit. These exceptions may differ by
/// rounding: normals (normalised again), emission (a factor times a strength), dielectrics' reflectances (an index of
/// refraction), and transforms of textures (an angle and scales). Fails as GlbFile::write().
void write_scene_glb(const std::filesystem::path& file, const Scene& scene, const ScenePose& pose,
                     const std::vector<GlbCamera>& cameras);
