#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// The parts of a glTF file, which point into its bytes.
struct GltfChunks {
    std::string_view json;
    std::optional<std::span<const uint8_t>> binary;  ///< the BIN chunk of a .glb
};

/// Splits a file by its first bytes, whatever its name: JSON, or the chunks of a .glb (glTF 2.0, section 4.4). Skips
/// chunks of other types. Fails with Error if a chunk passes the end of the file, if there is no JSON, or if a chunk
/// that may come once comes twice. `file` is named in messages.
GltfChunks split_chunks(std::string_view bytes, const std::string& file);
