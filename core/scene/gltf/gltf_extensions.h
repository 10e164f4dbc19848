#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <nlohmann/json.hpp>

/// Fails with Error, which names the program that converts such files where there is one, if extensionsRequired has an
/// extension that ssrlab cannot do.
void check_required_extensions(const nlohmann::json& root, const std::string& file);

/// Warns of extensions that stand in a part of the file and are passed by there, whether extensionsUsed lists them or
/// not. Those that change nothing that ssrlab shows are not mentioned, nor are those whose part says itself what is
/// missing.
void warn_of_extensions(const nlohmann::json& root, GltfFile& file);
