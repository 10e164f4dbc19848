#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <glm/glm.hpp>

// Members of a glTF extension object; an absent one is `fallback`, a malformed one an Error that names `what`.
float number_member(const GltfFile& file, const tinygltf::Value& object, const char* key, float fallback,
                    const std::string& what);
/// -1 if absent; a whole number otherwise, however it is written (2, 2.0 and 2e0 are one).
int index_member(const GltfFile& file, const tinygltf::Value& object, const char* key, const std::string& what);
template <int N>
glm::vec<N, float> vector_member(const GltfFile& file, const tinygltf::Value& object, const char* key,
                                 glm::vec<N, float> fallback, const std::string& what);

/// An extension by its name; nullptr if absent.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name);

/// `values` as a vector of `N` finite numbers, or `fallback` if empty.
template <int N>
glm::vec<N, float> fixed_vector(const GltfFile& file, const std::vector<double>& values, glm::vec<N, float> fallback,
                                const std::string& what);

/// The number if it is finite and within [min, max], the limit if it is one rounding of float32 beyond it, else an
/// Error.
float checked_number(const GltfFile& file, double value, double min, double max, const std::string& what);
