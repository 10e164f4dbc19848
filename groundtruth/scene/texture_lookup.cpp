#include "groundtruth/scene/texture_lookup.h"

#include "core/scene/texture_slots.h"

#include "core/png.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>
#include <array>
#include <cstring>
#include <map>
#include <new>
#include <utility>

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

/// The colour of a texel, linear and in [0, 1], by its RGBA codes as they lie in memory.
inline glm::vec4 decoded(uint32_t codes, bool is_srgb) {
    uint8_t code[4];
    std::memcpy(code, &codes, sizeof code);
    const float alpha = float(code[3]) * (1.0f / 255.0f);
    if (is_srgb) return {linear_from_code[code[0]], linear_from_code[code[1]], linear_from_code[code[2]], alpha};
    return glm::vec4(float(code[0]), float(code[1]), float(code[2]), float(code[3])) * (1.0f / 255.0f);
}

/// uv in texels. A coordinate beyond the range of int cannot address a texel; the fraction of so large a float is zero
/// anyway.
inline glm::vec2 texel_position(glm::ivec2 extent, glm::vec2 uv) {
    const glm::vec2 p = glm::clamp(uv * glm::vec2(extent), glm::vec2(-1e9f), glm::vec2(1e9f));
    return p.x == p.x && p.y == p.y ? p : glm::vec2(0.0f);
}

/// The first texel of a bilinear lookup and the last one, wrapped, and where between them uv is.
struct Footprint {
    glm::ivec2 first, last;
    glm::vec2 fraction;
};

/// `texture`: a Texture, or one in tiles.
inline Footprint footprint(const auto& texture, glm::vec2 uv) {
    const glm::ivec2 size(texture.extent);
    const glm::vec2 p = texel_position(size, uv) - 0.5f, corner = glm::floor(p);
    const glm::ivec2 first(corner);
    return {{wrap(first.x, size.x, texture.wrap_u), wrap(first.y, size.y, texture.wrap_v)},
            {wrap(first.x + 1, size.x, texture.wrap_u), wrap(first.y + 1, size.y, texture.wrap_v)},
            p - corner};
}

/// See sample_texture(). `codes(x, y)`: those of a texel.
inline glm::vec4 filtered(const auto& texture, glm::vec2 uv, const auto& codes) {
    const auto texel = [&](int x, int y) { return decoded(codes(x, y), texture.is_srgb); };
    if (texture.is_nearest) {
        const glm::ivec2 size(texture.extent), p(glm::floor(texel_position(size, uv)));
        return texel(wrap(p.x, size.x, texture.wrap_u), wrap(p.y, size.y, texture.wrap_v));
    }
    const auto [first, last, f] = footprint(texture, uv);
    return glm::mix(glm::mix(texel(first.x, first.y), texel(last.x, first.y), f.x),
                    glm::mix(texel(first.x, last.y), texel(last.x, last.y), f.x), f.y);
}

constexpr size_t huge_page = size_t(1) << 21;  // of x86-64 and of most ARM

}  // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
    return filtered(texture, uv, [&](int x, int y) {
        uint32_t codes;
        std::memcpy(&codes, &(*texture.rgba)[4 * (size_t(y) * texture.extent.x + size_t(x))], sizeof codes);
        return codes;
    });
}

TiledTextures::TiledTextures(const Scene& scene) : textures_(scene.textures.size()) {
    struct Block {
        size_t offset;  ///< in the copy, texels
        bool is_to_copy = true;
    };
    std::map<Texels, Block> blocks;  // texels that several textures show are one
    size_t count = 0;
    const auto add = [&](const TextureSlot& slot) {
        if (slot.texture < 0) return;
        const Texture& texture = scene.textures[size_t(slot.texture)];
        const glm::uvec2 tiles = (texture.extent + (tile_side - 1)) / tile_side;
        textures_[size_t(slot.texture)] = {.extent = glm::ivec2(texture.extent),
                                           .tiles_in_row = tiles.x,
                                           .wrap_u = texture.wrap_u,
                                           .wrap_v = texture.wrap_v,
                                           .is_srgb = texture.is_srgb,
                                           .is_nearest = texture.is_nearest};
        if (blocks.emplace(texture.rgba, Block{count}).second)
            count += size_t(tiles.x) * tiles.y * tile_side * tile_side;
    };
    for (const Material& material : scene.materials)
        for (const TextureSlot* slot : texture_slots(material)) add(*slot);
    if (count == 0) return;

    const size_t bytes = (count * sizeof(uint32_t) + huge_page - 1) / huge_page * huge_page;
    texels_.reset(static_cast<uint32_t*>(std::aligned_alloc(huge_page, bytes)));
    if (!texels_) throw std::bad_alloc();
    madvise(texels_.get(), bytes, MADV_HUGEPAGE);  // without it they are only slower
    for (size_t i = 0; i < textures_.size(); ++i) {
        Tiled& tiled = textures_[i];
        if (tiled.tiles_in_row == 0) continue;  // not read
        const auto block = blocks.find(scene.textures[i].rgba);
        uint32_t* const texels = texels_.get() + block->second.offset;
        tiled.texels = texels;
        if (!std::exchange(block->second.is_to_copy, false)) continue;
        const uint8_t* const rows = block->first->data();
        tbb::parallel_for(0, tiled.extent.y, [&](int y) {
            for (int x = 0; x < tiled.extent.x; ++x)
                std::memcpy(texels + tiled.index(x, y), rows + 4 * (size_t(y) * size_t(tiled.extent.x) + size_t(x)),
                            sizeof(uint32_t));
        });
    }
}

glm::vec4 TiledTextures::sample(int texture, glm::vec2 uv) const {
    const Tiled& tiled = textures_[size_t(texture)];
    return filtered(tiled, uv, [&](int x, int y) { return tiled.texels[tiled.index(x, y)]; });
}

void TiledTextures::prefetch(int texture, glm::vec2 uv) const {
    const Tiled& tiled = textures_[size_t(texture)];
    const Footprint at = footprint(tiled, uv);
    // The tiles at two corners: those of all four but for one lookup of 16.
    __builtin_prefetch(tiled.texels + tiled.index(at.first.x, at.first.y));
    __builtin_prefetch(tiled.texels + tiled.index(at.last.x, at.last.y));
}
