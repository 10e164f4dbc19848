#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <glm/glm.hpp>

// Members of a glTF extension object, of the types and lengths that gltf_schema.h checks; an absent one is `fallback`.
// A number that float32 cannot hold is an Error that names `what`.
float number_member(const GltfFile& file, const tinygltf::Value& object, const char* key, float fallback,
                    const std::string& what);
/// -1 if absent.
int index_member(const tinygltf::Value& object, const char* key);
template <int N>
glm::vec<N, float> vector_member(const GltfFile& file, const tinygltf::Value& object, const char* key,
                                 glm::vec<N, float> fallback, const std::string& what);

/// An extension by its name; nullptr if absent.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name);

/// `values` as a vector of `N` finite numbers, or `fallback` if empty.
template <int N>
glm::vec<N, float> fixed_vector(const GltfFile& file, const std::vector<double>& values, glm::vec<N, float> fallback,
                                const std::string& what);

/// The number if it is finite and within [min, max]; the limit if one rounding of float32 beyond it. Else fails with
/// Error.
float checked_number(const GltfFile& file, double value, double min, double max, const std::string& what);
