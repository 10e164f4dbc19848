#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <nlohmann/json.hpp>

/// Decodes the primitives that KHR_draco_mesh_compression has compressed into buffers of their own, with buffer views
/// and accessors behind those of `root`, and makes the primitives name these. Where the data cannot be decoded, the
/// accessors of the file are read, with a warning, if all of them have data. Else fails with Error.
void decode_draco(nlohmann::json& root, GltfFile& file);
