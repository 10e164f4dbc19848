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

/// A decoded image: codes as stored, RGBA, row by row from the top. Grey is repeated in R, G and B. Alpha is straight,
/// and opaque if the file has none.
struct DecodedImage {
    glm::uvec2 extent{0, 0};
    unsigned channel_bytes = 1;  ///< of a channel: 1, or 2 in the machine's byte order
    std::string stored = {};     ///< how the file holds colours: "16 bits, grey with alpha, interlaced"
    std::vector<uint8_t> rgba;
    std::vector<std::string> warnings;  ///< one sentence each, without `what`: flaws of the file that reading survives
    MemoryShare memory;                 ///< of `rgba`

    size_t texel_bytes() const { return 4 * size_t(channel_bytes); }
};

/// Decodes a PNG, JPEG or WebP, as the bytes say. Sets memory aside before using it. Fails with Error, which begins
/// with `what`: if the bytes are of another format, with the command that converts it; if they are cut or broken; if a
/// side is longer than `longest_side` pixels; if the image takes more than may be read (reading_limits.h).
DecodedImage decode_image(const EncodedImage& image, unsigned longest_side);

/// For decoders. Sets aside the memory of `image.rgba`, by its extent and channel_bytes. The returned share holds
/// `more_per_pixel` bytes per pixel more while the decoder works. Fails if a side is too long.
[[nodiscard]] MemoryShare reserve_memory(const EncodedImage& from, DecodedImage& image, unsigned longest_side,
                                         double more_per_pixel);
