// What classification hands to the passes after it; see AmdWork in passes.h.
#ifndef AMD_SSSR_LISTS_GLSL
#define AMD_SSSR_LISTS_GLSL

buffer ray_list { uint listed_ray[]; };
buffer counters { uint rays_being_listed, ray_count, tiles_being_listed, tile_count; };

const uint copy_horizontal = 1u << 29, copy_vertical = 1u << 30, copy_diagonal = 1u << 31;

uint pack_ray(ivec2 pixel) { return uint(pixel.x) | uint(pixel.y) << 15; }
ivec2 pixel_of_ray(uint ray) { return ivec2(ray & 0x7fffu, ray >> 15 & 0x3fffu); }

// Below this alpha a surface is a mirror: it needs no random numbers, traces in every pixel and is not filtered in
// space (SSSR 1.5, ffx_sssr_common.h).
const float mirror_alpha = 1e-4;
#endif
