#pragma once
#include "core/scene/scene.h"

#include <cstdlib>
#include <memory>
#include <vector>

/// The texel-filtered value of a texture at uv (0, 0 is the corner of the first texel): bilinear on level 0, or
/// nearest, with colours decoded from sRGB before filtering. RGBA in [0, 1], linear.
glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

/// The textures that shading reads, copied for paths, which come from anywhere to any texel: in tiles of 4x4 texels, a
/// cache line each (two of 16 bits), of which a bilinear lookup touches 1.6 in the mean, and 2.1 lines of rows; and in
/// huge pages where the system gives them, for a row of 1024 texels is a page of 4 KiB.
class TiledTextures {
public:
    /// Of the textures of `scene` those of base colours, metalness and roughness, normals and emission; texels that
    /// several show are held once. They take the memory of the scene's own, which stay: alpha masks read those. Fails
    /// with std::bad_alloc.
    explicit TiledTextures(const Scene& scene);

    /// sample_texture() of a texture of the scene. `texture`: its index, of one that was copied.
    glm::vec4 sample(int texture, glm::vec2 uv) const;

    /// Asks the processor for the texels that sample() will read.
    void prefetch(int texture, glm::vec2 uv) const;

private:
    static constexpr unsigned tile_side = 4;  ///< texels

    struct Tiled {
        glm::ivec2 extent{0};  ///< texels
        unsigned tiles_in_row = 0;
        unsigned words = 1;  ///< of 32 bits, of a texel
        TextureWrap wrap_u, wrap_v;
        bool is_srgb, is_nearest;
        const uint32_t* texels = nullptr;  ///< tile after tile, each row by row

        /// Of a texel among all: in `texels`, times `words`.
        size_t index(int x, int y) const {
            const unsigned column = unsigned(x), row = unsigned(y);
            const size_t tile = size_t(row / tile_side) * tiles_in_row + column / tile_side;
            return tile * (tile_side * tile_side) + row % tile_side * tile_side + column % tile_side;
        }
    };
    struct Free {
        void operator()(uint32_t* texels) const { std::free(texels); }
    };
    std::vector<Tiled> textures_;
    std::unique_ptr<uint32_t[], Free> texels_;
};
