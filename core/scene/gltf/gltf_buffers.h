#pragma once
#include "core/scene/gltf/gltf_file.h"

#include <nlohmann/json.hpp>
#include <optional>

/// Reads the buffers of a glTF into GltfFile::buffers: files beside it, data URIs, and the binary chunk of a .glb.
class BufferReader {
public:
    /// `root`: the whole document, whose data URIs are taken out as they are decoded.
    BufferReader(nlohmann::json& root, std::optional<std::span<const uint8_t>> binary, GltfFile& file);

    /// Reads the buffers that buffer views show, and no others. Fails with Error if a buffer is missing or shorter than
    /// its byteLength, or if a view passes the end of its buffer.
    void read_what_views_show();

    /// Whether the buffer exists and has bytes in the file or beside it.
    bool has_data(size_t index) const;

    /// One buffer, if it was not read yet.
    void read(size_t index);

    /// `where` begins messages: "a.gltf: bufferViews[3]".
    void check_view(const nlohmann::json& view, const std::string& where) const;

private:
    std::span<const uint8_t> bytes_of(nlohmann::json& buffer, size_t index, const std::string& what);

    nlohmann::json& root_;
    nlohmann::json none_ = nlohmann::json::array();
    nlohmann::json& buffers_;
    std::optional<std::span<const uint8_t>> binary_;
    GltfFile& file_;
    std::vector<bool> is_read_;
};
