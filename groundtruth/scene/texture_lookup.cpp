#include "groundtruth/scene/texture_lookup.h"

#include "core/png.h"
#include "core/scene/texture_slots.h"
#include "groundtruth/sampling/prefetch.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>
#include <array>
#include <cstring>
#include <map>
#include <new>
#include <utility>
#include <vector>

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

/// The same of 16 bits: a table, since the curve takes longer than all else of a lookup.
float linear_from_wide_code(uint16_t code) {
    static const std::vector<float> table = [] {
        std::vector<float> values(1 << 16);
        for (size_t c = 0; c < values.size(); ++c) values[c] = linear_from_srgb(float(c) / 65535.0f);
        return values;
    }();
    return table[code];
}

/// The RGBA codes of a texel as they lie in memory, of 8 bits and of 16.
using Codes = uint32_t;
using WideCodes = uint64_t;

inline glm::vec4 decoded(WideCodes codes, bool is_srgb) {
    uint16_t code[4];
    std::memcpy(code, &codes, sizeof code);
    const glm::vec4 values = glm::vec4(code[0], code[1], code[2], code[3]) / 65535.0f;
    if (!is_srgb) return values;
    return {linear_from_wide_code(code[0]), linear_from_wide_code(code[1]), linear_from_wide_code(code[2]), values.w};
}

/// The colour of a texel, linear and in [0, 1].
inline glm::vec4 decoded(Codes codes, bool is_srgb) {
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

template <class C>
C codes_at(const Texture& texture, int x, int y) {
    C codes;
    std::memcpy(&codes, &(*texture.rgba)[(size_t(y) * texture.extent.x + size_t(x)) * sizeof codes], sizeof codes);
    return codes;
}

}  // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
    if (texture.channel_bytes == 2)
        return filtered(texture, uv, [&](int x, int y) { return codes_at<WideCodes>(texture, x, y); });
    return filtered(texture, uv, [&](int x, int y) { return codes_at<Codes>(texture, x, y); });
}

void TiledTextures::Unmap::operator()(uint32_t* texels) const { munmap(texels, bytes); }

TiledTextures::TiledTextures(const Scene& scene) : textures_(scene.textures.size()) {
    struct Block {
        size_t offset;  ///< of its first tile in the copy, words of 32 bits
        unsigned tile_step;
        bool is_to_copy = true;
    };
    std::map<Texels, Block> blocks;  // texels that several textures show are one
    size_t count = 0;
    for (const Material& material : scene.materials) {
        std::map<std::array<unsigned, 3>, std::vector<Texels>>
            alike;  // by tiles and words of the material's new blocks
        for (const TextureSlot* slot : texture_slots(material)) {
            if (slot->texture < 0) continue;
            const Texture& texture = scene.textures[size_t(slot->texture)];
            const glm::uvec2 tiles = (texture.extent + (tile_side - 1)) / tile_side;
            textures_[size_t(slot->texture)] = {.extent = glm::ivec2(texture.extent),
                                                .tiles_in_row = tiles.x,
                                                .words = texture.channel_bytes,
                                                .wrap_u = texture.wrap_u,
                                                .wrap_v = texture.wrap_v,
                                                .is_srgb = texture.is_srgb,
                                                .is_nearest = texture.is_nearest};
            if (blocks.emplace(texture.rgba, Block{}).second)
                alike[{tiles.x, tiles.y, texture.channel_bytes}].push_back(texture.rgba);
        }
        for (const auto& [size, members] : alike) {
            const unsigned tile = tile_side * tile_side * size[2], step = tile * unsigned(members.size());
            for (size_t i = 0; i < members.size(); ++i) blocks[members[i]] = {count + i * tile, step};
            count += size_t(size[0]) * size[1] * step;
        }
    }
    if (count == 0) return;

    // Of new memory: what a heap has used before keeps its small pages.
    const size_t bytes = (count * sizeof(uint32_t) + huge_page - 1) / huge_page * huge_page;
    void* const mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    texels_ = {static_cast<uint32_t*>(mapped), {bytes}};
    madvise(mapped, bytes, MADV_HUGEPAGE);  // without it they are only slower
    for (size_t i = 0; i < textures_.size(); ++i) {
        Tiled& tiled = textures_[i];
        if (tiled.tiles_in_row == 0) continue;  // not read
        const auto block = blocks.find(scene.textures[i].rgba);
        uint32_t* const texels = texels_.get() + block->second.offset;
        tiled.texels = texels;
        tiled.tile_step = block->second.tile_step;
        if (!std::exchange(block->second.is_to_copy, false)) continue;
        const uint8_t* const rows = block->first->data();
        const auto copy =
            [&](auto codes) {  // of one texel; a row of a tile at a time, of a size that the compiler knows
                constexpr size_t texel = sizeof codes;
                constexpr int row_of_tile = int(tile_side);
                tbb::parallel_for(0, tiled.extent.y, [&](int y) {
                    const uint8_t* const row = rows + texel * size_t(y) * size_t(tiled.extent.x);
                    int x = 0;
                    for (; x + row_of_tile <= tiled.extent.x; x += row_of_tile)
                        std::memcpy(texels + tiled.index(x, y), row + texel * size_t(x), texel * row_of_tile);
                    for (; x < tiled.extent.x; ++x)
                        std::memcpy(texels + tiled.index(x, y), row + texel * size_t(x), texel);
                });
            };
        if (tiled.words == 2)
            copy(WideCodes());
        else
            copy(Codes());
    }
}

glm::vec4 TiledTextures::sample(int texture, glm::vec2 uv) const {
    const Tiled& tiled = textures_[size_t(texture)];
    if (tiled.words == 2)
        return filtered(tiled, uv, [&](int x, int y) {
            WideCodes codes;
            std::memcpy(&codes, tiled.texels + tiled.index(x, y), sizeof codes);
            return codes;
        });
    return filtered(tiled, uv, [&](int x, int y) { return tiled.texels[tiled.index(x, y)]; });
}

void TiledTextures::prefetch(int texture, glm::vec2 uv) const {
    const Tiled& tiled = textures_[size_t(texture)];
    const Footprint at = footprint(tiled, uv);
    // The tiles at two corners: those of all four but for one lookup of 16.
    prefetch_line(tiled.texels + tiled.index(at.first.x, at.first.y));
    prefetch_line(tiled.texels + tiled.index(at.last.x, at.last.y));
}
