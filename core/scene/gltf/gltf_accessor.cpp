#include "core/scene/gltf/gltf_file.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {
/// Equally spaced elements in a buffer, checked to lie inside it.
struct Elements {
    const unsigned char* data = nullptr;
    size_t stride = 0, count = 0;
};

Elements elements(const GltfFile& file, int view_index, size_t offset, size_t count, size_t element_size,
                  const std::string& what) {
    const tinygltf::Model& model = file.model;
    const auto& view =
        model.bufferViews[checked_index(file, view_index, model.bufferViews.size(), what + ": buffer view")];
    const auto buffer = file.buffers[checked_index(file, view.buffer, file.buffers.size(), what + ": buffer")];
    const size_t stride = view.byteStride ? view.byteStride : element_size;
    const bool fits = count == 0 || (offset <= view.byteLength && element_size <= view.byteLength - offset &&
                                     (count - 1) <= (view.byteLength - offset - element_size) / stride);
    if (!fits || stride < element_size || view.byteOffset > buffer.size() ||
        view.byteLength > buffer.size() - view.byteOffset)
        fail(file.name(), ": ", what, ": ", count, " elements of ", element_size, " bytes pass the end of buffer view ",
             view_index);
    return {buffer.data() + view.byteOffset + offset, stride, count};
}

template <class T>
T read_as(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

/// A component as the reader wants it: as a float, or as the unsigned integer that it is.
template <class T>
T component(const unsigned char* at, int type, bool is_normalized);

template <>
float component<float>(const unsigned char* at, int type, bool is_normalized) {
    const auto scaled = [&](float value, float max) { return is_normalized ? std::max(value / max, -1.0f) : value; };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(read_as<int8_t>(at), 127.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(read_as<uint8_t>(at), 255.0f);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(read_as<int16_t>(at), 32767.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(read_as<uint16_t>(at), 65535.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return float(read_as<uint32_t>(at));
        default:
            return read_as<float>(at);
    }
}

template <>
uint32_t component<uint32_t>(const unsigned char* at, int type, bool) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read_as<uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read_as<uint16_t>(at);
        default:
            return read_as<uint32_t>(at);
    }
}

/// What an accessor, or the sparse part of one, says of its elements.
struct ElementType {
    int component_type;
    bool is_normalized;
    unsigned components;
};

/// Elements that lie in a buffer view one after the other.
template <class T>
std::vector<T> read_view(const GltfFile& file, int view, size_t offset, size_t count, ElementType element,
                         const std::string& what) {
    const auto size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(element.component_type)));
    const Elements source = elements(file, view, offset, count, size * element.components, what);
    std::vector<T> values(count * element.components);
    if (std::is_same_v<T, float> && element.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
        for (size_t i = 0; i < count; ++i)
            std::memcpy(&values[i * element.components], source.data + i * source.stride, size * element.components);
        return values;
    }
    for (size_t i = 0; i < count; ++i)
        for (unsigned k = 0; k < element.components; ++k)
            values[i * element.components + k] =
                component<T>(source.data + i * source.stride + k * size, element.component_type, element.is_normalized);
    return values;
}

/// Replaces the elements which the sparse part names (glTF 2.0, section 3.6.2.3).
template <class T>
void apply_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, ElementType element,
                  const std::string& what, std::vector<T>& values) {
    const auto& sparse = accessor.sparse;
    if (size_t(sparse.count) > accessor.count)
        fail(file.name(), ": ", what, " has a malformed sparse part: ", sparse.count, " of ", accessor.count,
             " elements");
    const auto count = size_t(sparse.count);
    MemoryShare memory;
    memory.add(double(count) * double(sizeof(uint32_t) + element.components * sizeof(T)),
               file.name() + ": " + what + ": a sparse part of " + std::to_string(count) + " elements");
    const auto indices = read_view<uint32_t>(file, sparse.indices.bufferView, size_t(sparse.indices.byteOffset), count,
                                             {sparse.indices.componentType, false, 1}, what + " (sparse indices)");
    const auto replaced = read_view<T>(file, sparse.values.bufferView, size_t(sparse.values.byteOffset), count, element,
                                       what + " (sparse values)");
    for (size_t i = 0; i < count; ++i) {
        if (indices[i] >= accessor.count)
            fail(file.name(), ": ", what, " has the sparse index ", indices[i], " of ", accessor.count);
        std::copy_n(&replaced[i * element.components], element.components,
                    &values[indices[i] * size_t(element.components)]);
    }
}

const tinygltf::Accessor& checked_accessor(const GltfFile& file, int index, unsigned components,
                                           const std::string& what) {
    const auto& accessor =
        file.model.accessors[checked_index(file, index, file.model.accessors.size(), what + ": accessor")];
    const int found = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    if (found != int(components)) fail(file.name(), ": ", what, " must have ", components, " components, not ", found);
    if (accessor.count > UINT32_MAX)
        fail(file.name(), ": ", what, " has ", accessor.count, " elements, more than ", UINT32_MAX);
    return accessor;
}

/// The one reader of accessors: zeros without a buffer view, and what a sparse part replaces.
template <class T>
std::vector<T> read_accessor(const GltfFile& file, const tinygltf::Accessor& accessor, unsigned components,
                             const std::string& what) {
    const ElementType element{accessor.componentType, accessor.normalized, components};
    MemoryShare memory;
    memory.add(double(accessor.count) * components * sizeof(T),
               file.name() + ": " + what + " of " + std::to_string(accessor.count) + " elements");
    std::vector<T> values = accessor.bufferView < 0 ? std::vector<T>(accessor.count * components)
                                                    : read_view<T>(file, accessor.bufferView, accessor.byteOffset,
                                                                   accessor.count, element, what);
    if (accessor.sparse.isSparse) apply_sparse(file, accessor, element, what, values);
    return values;
}
}  // namespace

std::vector<float> read_floats(const GltfFile& file, int index, unsigned components, const std::string& what) {
    const auto values = read_accessor<float>(file, checked_accessor(file, index, components, what), components, what);
    const auto bad = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
    if (bad != values.end())
        fail(file.name(), ": ", what, ": element ", (bad - values.begin()) / components, " is not finite");
    return values;
}

std::vector<uint32_t> read_indices(const GltfFile& file, int index, const std::string& what, unsigned components) {
    const auto& accessor = checked_accessor(file, index, components, what);
    const int type = accessor.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(file.name(), ": ", what, " must be unsigned integers, not component type ", type);
    return read_accessor<uint32_t>(file, accessor, components, what);
}
