// Textures as paths read them are those of the scene.
#include "groundtruth/scene/texture_lookup.h"
#include "core/scene/texture_slots.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

/// Of 8 and of 16 bits: sizes that fill their tiles and that do not, all ways to wrap and to filter, texels that two
/// textures show, materials of one texture and of several, and coordinates far outside.
TEST(TiledTextures, HoldTheTexelsOfTheScene) {
    std::mt19937 random(1);
    Scene scene;
    const std::vector wraps = {TextureWrap::repeat, TextureWrap::mirrored_repeat, TextureWrap::clamp_to_edge};
    const auto texels_of = [&](glm::uvec2 extent, unsigned channel_bytes = 1) {
        std::vector<uint8_t> rgba(4 * channel_bytes * size_t(extent.x) * extent.y);
        for (uint8_t& code : rgba) code = uint8_t(random());
        return make_texels(std::move(rgba));
    };
    scene.textures.push_back({.extent = {2, 2}, .rgba = texels_of({2, 2})});
    for (const glm::uvec3 kind :
         {glm::uvec3(1, 1, 1), {3, 5, 1}, {3, 5, 2}, {4, 4, 1}, {17, 6, 2}, {17, 6, 1}, {64, 256, 1}}) {
        const glm::uvec2 extent(kind);
        const Texels texels = texels_of(extent, kind.z);
        for (const TextureWrap u : wraps)
            for (const TextureWrap v : wraps)
                for (const bool is_nearest : {false, true})
                    scene.textures.push_back({.extent = extent,
                                              .rgba = texels,
                                              .channel_bytes = kind.z,
                                              .is_srgb = u != v,
                                              .wrap_u = u,
                                              .wrap_v = v,
                                              .is_nearest = is_nearest});
    }
    // Each channel of a material reads some; the first texture is read by none, and not copied.
    for (int i = 1; i < int(scene.textures.size()); ++i) {
        Material material;
        const auto channels = texture_slots(material);
        channels[size_t(i) % channels.size()]->texture = i;
        scene.materials.push_back(material);
    }
    // Materials of several textures of one size, whose tiles lie side by side; the last also reads one of the others.
    for (const unsigned channel_bytes : {1u, 2u, 1u}) {
        const auto first = int(scene.textures.size());
        for (int i = 0; i < 3; ++i)
            scene.textures.push_back(
                {.extent = {9, 17}, .rgba = texels_of({9, 17}, channel_bytes), .channel_bytes = channel_bytes});
        Material material;
        const auto channels = texture_slots(material);
        for (int i = 0; i < 3; ++i) channels[size_t(i)]->texture = first + i;
        channels[3]->texture = first - 1;
        scene.materials.push_back(material);
    }
    const TiledTextures tiled(scene);
    std::uniform_real_distribution<float> coordinate(-3, 3);
    std::vector<glm::vec2> places = {{0, 0}, {1, 1}, {-1e30f, 0.5f}, {0.5f, std::numeric_limits<float>::quiet_NaN()}};
    while (places.size() < 2000) places.emplace_back(coordinate(random), coordinate(random));
    for (int i = 1; i < int(scene.textures.size()); ++i)
        for (const glm::vec2 uv : places) {
            tiled.prefetch(i, uv);
            const glm::vec4 found = tiled.sample(i, uv), expected = sample_texture(scene.textures[size_t(i)], uv);
            for (int c = 0; c < 4; ++c)  // where products and sums are fused is the compiler's choice, for each of both
                ASSERT_NEAR(found[c], expected[c], 0x1p-22f) << i << ' ' << uv.x << ' ' << uv.y << ' ' << c;
        }
}

/// 16 bits are v / 65535, and sRGB codes of 16 bits those of the curve (IEC 61966-2-1).
TEST(TiledTextures, HaveSixteenBits) {
    for (const bool is_srgb : {false, true}) {
        std::vector<uint8_t> rgba(8);
        const uint16_t codes[] = {6808, 30000, 100, 40001};
        std::memcpy(rgba.data(), codes, sizeof codes);
        Scene scene;
        scene.textures = {{.extent = {1, 1}, .rgba = make_texels(rgba), .channel_bytes = 2, .is_srgb = is_srgb}};
        scene.materials = {{.base_color_texture = {.texture = 0}}};
        const glm::vec4 found = TiledTextures(scene).sample(0, {0.3f, 0.9f});
        for (int c = 0; c < 4; ++c) {
            const double code = codes[c] / 65535.0,
                         light = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
            EXPECT_NEAR(found[c], is_srgb && c < 3 ? light : code, 2e-7) << is_srgb << c;  // float32
        }
    }
}
