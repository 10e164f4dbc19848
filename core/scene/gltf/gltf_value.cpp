#include "core/scene/gltf/gltf_value.h"

#include "core/error.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

float checked_number(const GltfFile& file, double value, double min, double max, const std::string& what) {
    // Exporters compute in float32: what is one rounding of it beyond a limit is the limit.
    const float infinity = std::numeric_limits<float>::infinity();
    const bool is_in_reach =
        value >= double(std::nextafter(float(min), -infinity)) && value <= double(std::nextafter(float(max), infinity));
    if (!is_in_reach) fail(file.name(), ": ", what, " = ", value, " is outside [", min, ", ", max, "]");
    return float(std::clamp(value, min, max));
}

float number_member(const GltfFile& file, const tinygltf::Value& object, const char* key, float fallback,
                    const std::string& what) {
    if (!object.IsObject() || !object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsNumber()) fail(file.name(), ": ", what, ": '", key, "' must be a number");
    return checked_number(file, value.GetNumberAsDouble(), -FLT_MAX, FLT_MAX, what + ": '" + key + "'");
}

int index_member(const GltfFile& file, const tinygltf::Value& object, const char* key, const std::string& what) {
    if (!object.IsObject() || !object.Has(key)) return -1;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsInt() || value.GetNumberAsInt() < 0)
        fail(file.name(), ": ", what, ": '", key, "' must be a whole number of 0 or more");
    return value.GetNumberAsInt();
}

glm::vec2 vec2_member(const GltfFile& file, const tinygltf::Value& object, const char* key, glm::vec2 fallback,
                      const std::string& what) {
    if (!object.IsObject() || !object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    const bool fits = value.IsArray() && value.ArrayLen() == 2 && value.Get(0).IsNumber() && value.Get(1).IsNumber();
    if (!fits) fail(file.name(), ": ", what, ": '", key, "' must be an array of two numbers");
    return {checked_number(file, value.Get(0).GetNumberAsDouble(), -FLT_MAX, FLT_MAX, what),
            checked_number(file, value.Get(1).GetNumberAsDouble(), -FLT_MAX, FLT_MAX, what)};
}

template <int N>
glm::vec<N, float> fixed_vector(const GltfFile& file, const std::vector<double>& values, glm::vec<N, float> fallback,
                                const std::string& what) {
    if (values.empty()) return fallback;
    if (values.size() != size_t(N)) fail(file.name(), ": ", what, " must have ", N, " numbers, not ", values.size());
    glm::vec<N, float> vector;
    for (int i = 0; i < N; ++i) vector[i] = checked_number(file, values[size_t(i)], -FLT_MAX, FLT_MAX, what);
    return vector;
}
template glm::vec3 fixed_vector<3>(const GltfFile&, const std::vector<double>&, glm::vec3, const std::string&);
template glm::vec4 fixed_vector<4>(const GltfFile&, const std::vector<double>&, glm::vec4, const std::string&);
