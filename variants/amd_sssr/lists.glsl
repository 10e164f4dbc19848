// What classification hands to the later passes; see the buffers in technique.json.
#ifndef AMD_SSSR_LISTS_GLSL
#define AMD_SSSR_LISTS_GLSL
#include "amd_sssr/mirror.h"

buffer ray_list { uint listed_ray[]; };
buffer tile_list { uint listed_tile[]; };
buffer counters { uint rays_being_listed, ray_count, tiles_being_listed, tile_count; };

const uint copy_horizontal = 1u << 29, copy_vertical = 1u << 30, copy_diagonal = 1u << 31;

uint pack_ray(ivec2 pixel) { return uint(pixel.x) | uint(pixel.y) << 15; }
ivec2 pixel_of_ray(uint ray) { return ivec2(ray & 0x7fffu, ray >> 15 & 0x3fffu); }

// By the tile's first pixel.
uint pack_tile(ivec2 start) { return uint(start.x) | uint(start.y) << 16; }
ivec2 start_of_tile(uint tile) { return ivec2(tile & 0xffffu, tile >> 16); }

// The alpha by which a pixel is rated: as it is stored for the passes after classification; in 8 bits the nearest code,
// rounded again, so that no device's conversion from and to it matters.
float rated_alpha(float alpha) {
    return rate_stored_roughness && !float_roughness ? floor(alpha * 255.0 + 0.5) / 255.0 : alpha;
}
bool is_glossy(float alpha) { return rated_alpha(alpha) < roughness_threshold_alpha; }
bool is_mirror(float alpha) { return rated_alpha(alpha) < amd_mirror_alpha; }
#endif
