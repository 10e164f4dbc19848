#include "core/scene/gltf/gltf_value.h"

#include "core/error.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

float checked_number(const GltfFile& file, double value, double min, double max, const std::string& what) {
    // Exporters compute in float32 and write its digits: what is one rounding of it beyond a limit is the limit.
    const float infinity = std::numeric_limits<float>::infinity();
    const bool is_in_reach = std::abs(value) <= double(FLT_MAX) &&
                             float(value) >= std::nextafter(float(min), -infinity) &&
                             float(value) <= std::nextafter(float(max), infinity);
    if (!is_in_reach) fail(file.name(), ": ", what, " = ", value, " is outside [", min, ", ", max, "]");
    return float(std::clamp(value, min, max));
}

float number_member(const GltfFile& file, const tinygltf::Value& object, const char* key, float fallback,
                    const std::string& what) {
    if (!object.Has(key)) return fallback;
    return checked_number(file, object.Get(key).GetNumberAsDouble(), -FLT_MAX, FLT_MAX, what + ": '" + key + "'");
}

int index_member(const tinygltf::Value& object, const char* key) {
    return object.Has(key) ? object.Get(key).GetNumberAsInt() : -1;
}

template <int N>
glm::vec<N, float> vector_member(const GltfFile& file, const tinygltf::Value& object, const char* key,
                                 glm::vec<N, float> fallback, const std::string& what) {
    if (!object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    glm::vec<N, float> vector;
    for (int i = 0; i < N; ++i)
        vector[i] = checked_number(file, value.Get(i).GetNumberAsDouble(), -FLT_MAX, FLT_MAX, what + ": '" + key + "'");
    return vector;
}
template glm::vec2 vector_member<2>(const GltfFile&, const tinygltf::Value&, const char*, glm::vec2,
                                    const std::string&);
template glm::vec3 vector_member<3>(const GltfFile&, const tinygltf::Value&, const char*, glm::vec3,
                                    const std::string&);
template glm::vec4 vector_member<4>(const GltfFile&, const tinygltf::Value&, const char*, glm::vec4,
                                    const std::string&);

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

template <int N>
glm::vec<N, float> fixed_vector(const GltfFile& file, const std::vector<double>& values, glm::vec<N, float> fallback,
                                const std::string& what) {
    if (values.empty()) return fallback;
    glm::vec<N, float> vector;
    for (int i = 0; i < N; ++i) vector[i] = checked_number(file, values[size_t(i)], -FLT_MAX, FLT_MAX, what);
    return vector;
}
template glm::vec3 fixed_vector<3>(const GltfFile&, const std::vector<double>&, glm::vec3, const std::string&);
template glm::vec4 fixed_vector<4>(const GltfFile&, const std::vector<double>&, glm::vec4, const std::string&);
