#pragma once
#include "core/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

/// The texel-filtered value of a texture at uv (0, 0 is the corner of the first texel): bilinear on level 0, or
/// nearest, with colours decoded from sRGB before filtering. RGBA in [0, 1], linear.
glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

/// A copy of the textures that shading reads, for paths that access texels in random order. Tiles of 4x4 texels fill a
/// cache line (two with 16 bits). A bilinear lookup touches 1.6 such lines on average, and 2.1 lines of plain rows. The
/// textures of a material are read at the same place: their tiles of one place are neighbours, so that they share a
/// page. The copy uses huge pages if the system has them: a row of 1024 texels is a page of 4 KiB.
class TiledTextures {
public:
    /// Copies the scene's textures that texture_slots() lists; shared texels are copied once. The copy takes as much
    /// memory as the scene's textures, which remain for alpha masks. Fails with std::bad_alloc.
    explicit TiledTextures(const Scene& scene);

    /// sample_texture() of a copied texture. `texture`: its index in the scene.
    glm::vec4 sample(int texture, glm::vec2 uv) const;

    /// Prefetches the texels that sample() will read.
    void prefetch(int texture, glm::vec2 uv) const;

private:
    static constexpr unsigned tile_side = 4;  ///< texels

    struct Tiled {
        glm::ivec2 extent{0};  ///< texels
        unsigned tiles_in_row = 0;
        unsigned words = 1;      ///< of 32 bits, of a texel
        unsigned tile_step = 0;  ///< words from a tile to the next: other textures' tiles may lie between them
        TextureWrap wrap_u, wrap_v;
        bool is_srgb, is_nearest;
        const uint32_t* texels = nullptr;  ///< tile after tile, each row by row

        /// Index of a texel in `texels`.
        size_t index(int x, int y) const {
            const unsigned column = unsigned(x), row = unsigned(y);
            const size_t tile = size_t(row / tile_side) * tiles_in_row + column / tile_side;
            return tile * tile_step + (row % tile_side * tile_side + column % tile_side) * words;
        }
    };
    struct Unmap {
        size_t bytes;
        void operator()(uint32_t* texels) const;
    };
    std::vector<Tiled> textures_;
    std::unique_ptr<uint32_t[], Unmap> texels_;
};
