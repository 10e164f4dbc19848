#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Fails with Error, which names the key's path, where a key that glTF 2.0 knows has a value of another type than it
/// says, one that it lists no such value for, or none although it must, and where the file is of another version.
/// tinygltf takes many of these for absent. What numbers may be is checked where they are used.
void check_gltf_schema(const nlohmann::json& root, const std::string& file);

/// Makes numbers whose fractional part is 0 integers where glTF 2.0 has integers: they may be written 1.0 or 1e0
/// (section 2.7, item 5). `root` is an object.
void make_integers_whole(nlohmann::json& root);
