#include "experiments/bridges/scene_for/texture_png.h"

#include "core/png.h"

#include <algorithm>

std::vector<std::byte> texture_png(const Texture& texture) {
    const std::vector<uint8_t>& rgba = *texture.rgba;
    const size_t bytes = texture.channel_bytes, texel = 4 * bytes, color = 3 * bytes;
    bool is_opaque = true;
    for (size_t i = 0; i < rgba.size(); i += texel)
        for (size_t k = color; k < texel; ++k) is_opaque &= rgba[i + k] == 0xFF;
    if (!is_opaque) return encode_png(texture.extent, 4, texture.channel_bytes, rgba);
    std::vector<uint8_t> rgb(rgba.size() / texel * color);
    for (size_t i = 0; i < rgba.size() / texel; ++i) std::copy_n(&rgba[i * texel], color, &rgb[i * color]);
    return encode_png(texture.extent, 3, texture.channel_bytes, rgb);
}
