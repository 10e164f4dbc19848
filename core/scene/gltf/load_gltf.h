#pragma once
#include "core/scene/scene.h"

#include <filesystem>

/// A glTF 2.0 file (.gltf or .glb): meshes, materials, nodes, animation, lights, cameras. Fails with Error if something
/// is missing, truncated or malformed.
Scene load_gltf(const std::filesystem::path& file);
