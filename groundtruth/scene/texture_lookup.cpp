#include "groundtruth/scene/texture_lookup.h"

#include "core/png.h"

#include <array>
#include <cmath>

namespace {

const std::array<float, 256> linear_from_code = [] {
    std::array<float, 256> table;
    for (int code = 0; code < 256; ++code) table[code] = linear_from_srgb(float(code) / 255.0f);
    return table;
}();

inline int wrap(int i, int size, TextureWrap mode) {
    if (unsigned(i) < unsigned(size)) return i;
    if (mode == TextureWrap::clamp_to_edge) return i < 0 ? 0 : size - 1;
    const bool is_power_of_two = (size & (size - 1)) == 0;  // most are, and a division costs more than the texel
    if (mode == TextureWrap::repeat) return is_power_of_two ? i & (size - 1) : (i % size + size) % size;
    const int period = 2 * size, j = (i % period + period) % period;
    return j < size ? j : period - 1 - j;
}

inline glm::vec4 texel(const Texture& texture, int x, int y) {
    const uint8_t* code = &(*texture.rgba)[4 * (size_t(y) * texture.extent.x + size_t(x))];
    const float alpha = float(code[3]) * (1.0f / 255.0f);
    if (texture.is_srgb)
        return {linear_from_code[code[0]], linear_from_code[code[1]], linear_from_code[code[2]], alpha};
    return glm::vec4(float(code[0]), float(code[1]), float(code[2]), float(code[3])) * (1.0f / 255.0f);
}

/// uv in texels. A coordinate beyond the range of int cannot address a texel; the fraction of so large a float is zero
/// anyway.
inline glm::vec2 texel_position(const Texture& texture, glm::vec2 uv) {
    const glm::vec2 p = glm::clamp(uv * glm::vec2(texture.extent), glm::vec2(-1e9f), glm::vec2(1e9f));
    return p.x == p.x && p.y == p.y ? p : glm::vec2(0.0f);
}

}  // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
    const glm::ivec2 size(texture.extent);
    glm::vec2 p = texel_position(texture, uv);
    if (texture.is_nearest)
        return texel(texture, wrap(int(std::floor(p.x)), size.x, texture.wrap_u),
                     wrap(int(std::floor(p.y)), size.y, texture.wrap_v));

    p -= 0.5f;
    const glm::vec2 corner = glm::floor(p), f = p - corner;
    const int x0 = wrap(int(corner.x), size.x, texture.wrap_u), x1 = wrap(int(corner.x) + 1, size.x, texture.wrap_u);
    const int y0 = wrap(int(corner.y), size.y, texture.wrap_v), y1 = wrap(int(corner.y) + 1, size.y, texture.wrap_v);
    return glm::mix(glm::mix(texel(texture, x0, y0), texel(texture, x1, y0), f.x),
                    glm::mix(texel(texture, x0, y1), texel(texture, x1, y1), f.x), f.y);
}

void prefetch_texture(const Texture& texture, glm::vec2 uv) {
    const glm::ivec2 size(texture.extent);
    const glm::vec2 p = glm::floor(texel_position(texture, uv) - 0.5f);
    const int x = wrap(int(p.x), size.x, texture.wrap_u);
    for (int dy = 0; dy < 2; ++dy) {
        const int y = wrap(int(p.y) + dy, size.y, texture.wrap_v);
        __builtin_prefetch(&(*texture.rgba)[4 * (size_t(y) * texture.extent.x + size_t(x))]);
    }
}
