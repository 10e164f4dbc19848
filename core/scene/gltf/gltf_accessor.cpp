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

size_t component_size(const GltfFile& file, int type, const std::string& what) {
    const int size = tinygltf::GetComponentSizeInBytes(uint32_t(type));
    if (size <= 0 || type == TINYGLTF_COMPONENT_TYPE_DOUBLE)
        fail(file.name(), ": ", what, " has the unknown component type ", type);
    return size_t(size);
}

Elements elements(const GltfFile& file, int view_index, size_t offset, size_t count, size_t element_size,
                  const std::string& what) {
    const tinygltf::Model& model = file.model;
    const auto& view =
        model.bufferViews[checked_index(file, view_index, model.bufferViews.size(), what + ": buffer view")];
    const auto& buffer = model.buffers[checked_index(file, view.buffer, model.buffers.size(), what + ": buffer")];
    const size_t stride = view.byteStride ? view.byteStride : element_size;
    const bool fits = count == 0 || (offset <= view.byteLength && element_size <= view.byteLength - offset &&
                                     (count - 1) <= (view.byteLength - offset - element_size) / stride);
    if (!fits || stride < element_size || view.byteOffset > buffer.data.size() ||
        view.byteLength > buffer.data.size() - view.byteOffset)
        fail(file.name(), ": ", what, ": ", count, " elements of ", element_size, " bytes pass the end of buffer view ",
             view_index);
    return {buffer.data.data() + view.byteOffset + offset, stride, count};
}

template <class T>
T read_as(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

float component(const unsigned char* at, int type, bool is_normalized) {
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
        case TINYGLTF_COMPONENT_TYPE_INT:
            return float(read_as<int32_t>(at));
        default:
            return read_as<float>(at);
    }
}

uint32_t unsigned_component(const unsigned char* at, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read_as<uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read_as<uint16_t>(at);
        default:
            return read_as<uint32_t>(at);
    }
}

std::vector<uint32_t> read_unsigned(const GltfFile& file, int view, size_t offset, size_t count, int type,
                                    const std::string& what) {
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(file.name(), ": ", what, " must be unsigned integers, not component type ", type);
    const Elements source = elements(file, view, offset, count, component_size(file, type, what), what);
    MemoryShare memory;
    memory.add(double(count) * sizeof(uint32_t),
               file.name() + ": " + what + " of " + std::to_string(count) + " elements");
    std::vector<uint32_t> values(count);
    for (size_t i = 0; i < count; ++i) values[i] = unsigned_component(source.data + i * source.stride, type);
    return values;
}

/// Replaces the elements which the sparse part names (glTF 2.0, section 3.6.2.3).
void apply_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, unsigned components,
                  const std::string& what, std::vector<float>& values) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || size_t(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0)
        fail(file.name(), ": ", what, " has a malformed sparse part");
    const auto indices = read_unsigned(file, sparse.indices.bufferView, size_t(sparse.indices.byteOffset),
                                       size_t(sparse.count), sparse.indices.componentType, what + " (sparse indices)");
    const size_t size = component_size(file, accessor.componentType, what);
    const Elements source = elements(file, sparse.values.bufferView, size_t(sparse.values.byteOffset), indices.size(),
                                     size * components, what);
    for (size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= accessor.count)
            fail(file.name(), ": ", what, " has the sparse index ", indices[i], " of ", accessor.count);
        for (unsigned k = 0; k < components; ++k)
            values[size_t(indices[i]) * components + k] =
                component(source.data + i * source.stride + k * size, accessor.componentType, accessor.normalized);
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
}  // namespace

std::vector<float> read_floats(const GltfFile& file, int index, unsigned components, const std::string& what) {
    const auto& accessor = checked_accessor(file, index, components, what);
    const size_t size = component_size(file, accessor.componentType, what);
    MemoryShare memory;
    memory.add(double(accessor.count) * components * sizeof(float),
               file.name() + ": " + what + " of " + std::to_string(accessor.count) + " elements");
    std::vector<float> values;
    if (accessor.bufferView >= 0) {
        const Elements source =
            elements(file, accessor.bufferView, accessor.byteOffset, accessor.count, size * components, what);
        values.resize(accessor.count * components);
        for (size_t i = 0; i < accessor.count; ++i)
            for (unsigned k = 0; k < components; ++k)
                values[i * components + k] =
                    component(source.data + i * source.stride + k * size, accessor.componentType, accessor.normalized);
    } else {
        values.assign(accessor.count * components, 0.0f);
    }
    if (accessor.sparse.isSparse) apply_sparse(file, accessor, components, what, values);
    const auto bad = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
    if (bad != values.end())
        fail(file.name(), ": ", what, ": element ", (bad - values.begin()) / components, " is not finite");
    return values;
}

std::vector<uint32_t> read_indices(const GltfFile& file, int index, const std::string& what) {
    const auto& accessor = checked_accessor(file, index, 1, what);
    return read_unsigned(file, accessor.bufferView, accessor.byteOffset, accessor.count, accessor.componentType, what);
}
