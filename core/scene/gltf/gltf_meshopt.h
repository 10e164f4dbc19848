#pragma once
#include "core/scene/gltf/gltf_buffers.h"

/// The buffer views that EXT_meshopt_compression, or KHR_meshopt_compression with the same modes and filters, has
/// compressed.
class MeshoptViews {
public:
    /// Makes these views of `root` show the compressed bytes, for read_buffers().
    MeshoptViews(nlohmann::json& root, const std::string& file);

    /// Decodes the bytes into buffers of their own, which the views then show. What cannot be decoded is taken from the
    /// fallback that the file may have, with a warning. Fails with Error where there is none.
    void decode(nlohmann::json& root, BufferReader& buffers, GltfFile& file) const;

private:
    struct View {
        size_t index;
        nlohmann::json uncompressed, compression;  ///< the view as it stands in the file, and its extension
        std::string extension, what;
    };
    std::vector<View> views_;
};
