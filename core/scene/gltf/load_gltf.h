#pragma once
#include "core/scene/scene.h"

#include <filesystem>

/// A glTF 2.0 file (.gltf or .glb): meshes, materials, nodes, animation, lights, cameras. Fails with Error if something
/// is missing, truncated or malformed.
Scene load_gltf(const std::filesystem::path& file);

/// glTF lets cameras share a name, and nodes a camera; here a name means one camera. The second of a name gets "_2".
void make_names_unique(std::vector<SceneCamera>& cameras);
