#pragma once
#include "core/scene/scene.h"

#include <filesystem>

/// What a glTF file leaves to its user.
struct GltfChoices {
    std::string material_variant;  ///< one of KHR_materials_variants; "": the materials that the file shows without
    bool draws_blended_opaque = false;  ///< alphaMode BLEND; else it is cut where alpha is below 0.5
};

/// A glTF 2.0 file (.gltf or .glb): meshes, materials, nodes, animation, lights, cameras. Fails with Error if something
/// is missing, truncated or malformed, or if it has no such variant.
Scene load_gltf(const std::filesystem::path& file, const GltfChoices& choices = {});

/// glTF lets cameras share a name, and nodes a camera; here a name means one camera. The second of a name gets "_2".
void make_names_unique(std::vector<SceneCamera>& cameras);
