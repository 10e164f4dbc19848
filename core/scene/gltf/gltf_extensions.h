#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <nlohmann/json.hpp>

/// Fails with Error if extensionsRequired has an extension that ssrlab does not support. The message names a program
/// that converts such files, if there is one.
void check_required_extensions(const nlohmann::json& root, const std::string& file);

/// Warns of extensions in the file that ssrlab ignores, whether extensionsUsed lists them or not. Leaves out extensions
/// that change nothing in the picture, and those whose readers warn themselves.
void warn_of_extensions(const nlohmann::json& root, GltfFile& file);
