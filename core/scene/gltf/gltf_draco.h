#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <nlohmann/json.hpp>

/// Decodes primitives of KHR_draco_mesh_compression into new buffers. Appends buffer views and accessors to `root`, and
/// makes the primitives name these. If the data cannot be decoded, warns and reads the file's own accessors, if all
/// have data. Else fails with Error.
void decode_draco(nlohmann::json& root, GltfFile& file);
