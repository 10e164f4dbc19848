#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Fails with Error, which names the key's path, if a key of glTF 2.0 has a value of the wrong type, a value that glTF
/// does not list, or none although it must. Also fails for another version of glTF. tinygltf takes many such values for
/// absent. Ranges of numbers are checked where they are used.
void check_gltf_schema(const nlohmann::json& root, const std::string& file);

/// Makes numbers whose fractional part is 0 integers where glTF 2.0 has integers: they may be written 1.0 or 1e0
/// (section 2.7, item 5). `root` is an object.
void make_integers_whole(nlohmann::json& root);
