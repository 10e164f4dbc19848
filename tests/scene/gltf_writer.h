#pragma once
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// RFC 4648, section 4.
std::string base64(const std::string& bytes);

/// Builds small glTF files for tests: a JSON document and one buffer.
struct GltfWriter {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}},         {"scene", 0},
                           {"scenes", {{{"nodes", {0}}}}},          {"nodes", nlohmann::json::array()},
                           {"meshes", nlohmann::json::array()},     {"accessors", nlohmann::json::array()},
                           {"bufferViews", nlohmann::json::array()}};
    std::vector<std::byte> bytes;

    /// Returns the index of the accessor.
    int floats(const std::vector<float>& values, const std::string& type) {
        const int components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "MAT4" ? 16 : 4;
        nlohmann::json accessor = {
            {"componentType", 5126}, {"type", type}, {"count", values.size() / size_t(components)}};
        if (type == "VEC3") accessor["min"] = {-1e6, -1e6, -1e6}, accessor["max"] = {1e6, 1e6, 1e6};
        return add(accessor, values.data(), values.size() * 4);
    }
    /// Of vec4, as joints and their weights are.
    int bytes_of_4(const std::vector<uint8_t>& values, bool is_normalized = false) {
        return add(
            {{"componentType", 5121}, {"type", "VEC4"}, {"count", values.size() / 4}, {"normalized", is_normalized}},
            values.data(), values.size());
    }
    int indices(const std::vector<uint16_t>& values) {
        return add({{"componentType", 5123}, {"type", "SCALAR"}, {"count", values.size()}}, values.data(),
                   values.size() * 2);
    }

    int view(const void* data, size_t size) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        bytes.insert(bytes.end(), static_cast<const std::byte*>(data), static_cast<const std::byte*>(data) + size);
        return int(json["bufferViews"].size()) - 1;
    }

    /// A unit square in the xy plane, facing +z; uv (0, 0) at its upper left, as glTF has it.
    nlohmann::json quad() {
        return {{"attributes",
                 {{"POSITION", floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3")},
                  {"NORMAL", floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                  {"TEXCOORD_0", floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2")}}},
                {"indices", indices({0, 1, 2, 0, 2, 3})}};
    }
    void add_mesh_node(const nlohmann::json& primitive) {
        json["meshes"].push_back({{"primitives", {primitive}}});
        json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    }

    std::filesystem::path write_glb(const std::filesystem::path& file);
    std::filesystem::path write_gltf(const std::filesystem::path& file);  ///< the buffer beside it as .bin

private:
    int add(nlohmann::json accessor, const void* data, size_t size) {
        accessor["bufferView"] = view(data, size);
        json["accessors"].push_back(accessor);
        return int(json["accessors"].size()) - 1;
    }
};
