#pragma once
#include "core/reading_limits.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

/// The bytes of an image file and what messages call it.
struct EncodedImage {
    std::span<const uint8_t> bytes;
    std::string what;  ///< begins each message: "a.gltf: image 0 ('wood.png')"
    std::string file;  ///< its name in the commands that messages give: "wood.png"
};

/// What a decoder makes of them: codes as they are stored, RGBA, row by row from the top. Grey is repeated; alpha is
/// straight, and opaque where there is none.
struct DecodedImage {
    glm::uvec2 extent{0, 0};
    unsigned channel_bytes = 1;  ///< of a channel: 1, or 2 in the machine's byte order
    std::string stored = {};     ///< how the file holds colours: "16 bits, grey with alpha, interlaced"
    std::vector<uint8_t> rgba;
    std::vector<std::string>
        warnings;        ///< one sentence each, without `what`: what the file has amiss, and was read all the same
    MemoryShare memory;  ///< that of rgba

    size_t texel_bytes() const { return 4 * size_t(channel_bytes); }
};

/// Decodes a PNG, JPEG or WebP, whichever the bytes are. Memory is set aside before it is spent. Fails with Error,
/// which begins with `what`: if the bytes are of another format, with the command that converts it; if they are cut or
/// broken; if a side is longer than `longest_side` pixels; if the image takes more than may be read (reading_limits.h).
DecodedImage decode_image(const EncodedImage& image, unsigned longest_side);

/// For decoders: fails if a side is too long; sets aside the memory of `image.rgba` by its extent and channel_bytes,
/// and in the share that is returned `more_per_pixel` bytes for as long as the decoder works.
[[nodiscard]] MemoryShare reserve_memory(const EncodedImage& from, DecodedImage& image, unsigned longest_side,
                                         double more_per_pixel);
