#pragma once
#include "core/scene/gltf/gltf_buffers.h"

/// The buffer views that EXT_meshopt_compression, or KHR_meshopt_compression with the same modes and filters, has
/// compressed.
class MeshoptViews {
public:
    /// Makes these views of `root` show the compressed bytes, for BufferReader.
    MeshoptViews(nlohmann::json& root, const std::string& file);

    /// Decodes the bytes into new buffers, which the views then show. If bytes cannot be decoded, warns and takes the
    /// file's fallback. Fails with Error if there is none.
    void decode(nlohmann::json& root, BufferReader& buffers, GltfFile& file) const;

private:
    struct View {
        size_t index;
        nlohmann::json uncompressed, compression;  ///< the view as it stands in the file, and its extension
        std::string extension, what;
    };
    std::vector<View> views_;
};
