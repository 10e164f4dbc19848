#include "core/scene/gltf/encoded_image.h"

#include "core/webp.h"

#include <algorithm>
#include <array>

namespace {

/// Big-endian; 0 behind the end.
uint32_t integer_at(std::span<const uint8_t> bytes, size_t at, size_t size) {
    uint32_t value = 0;
    for (size_t i = at; i < at + size; ++i) value = value << 8 | (i < bytes.size() ? bytes[i] : 0u);
    return value;
}

/// PNG (ISO/IEC 15948), section 11.2.2: IHDR comes first.
glm::uvec2 png_extent(std::span<const uint8_t> bytes) { return {integer_at(bytes, 16, 4), integer_at(bytes, 20, 4)}; }

/// JPEG (ITU-T T.81), annex B: segments, of which a frame header SOF0 to SOF15 has the size. DHT, JPG and DAC are no
/// SOF, and markers without a segment have no length.
glm::uvec2 jpeg_extent(std::span<const uint8_t> bytes) {
    for (size_t at = 2; at + 4 <= bytes.size();) {
        if (bytes[at] != 0xFF) return {0, 0};
        const uint8_t marker = bytes[at + 1];
        if (marker == 0xFF) {  // fills
            ++at;
        } else if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {
            at += 2;
        } else if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
            return {integer_at(bytes, at + 7, 2), integer_at(bytes, at + 5, 2)};
        } else {
            at += 2 + integer_at(bytes, at + 2, 2);
        }
    }
    return {0, 0};
}

bool begins_with(std::span<const uint8_t> bytes, std::span<const uint8_t> mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
}

}  // namespace

bool is_png(std::span<const uint8_t> bytes) {
    return begins_with(bytes, std::array<uint8_t, 8>{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'});
}

glm::uvec2 encoded_extent(std::span<const uint8_t> bytes) {
    if (is_png(bytes)) return png_extent(bytes);
    if (begins_with(bytes, std::array<uint8_t, 3>{0xFF, 0xD8, 0xFF})) return jpeg_extent(bytes);
    return webp_extent(bytes);
}
