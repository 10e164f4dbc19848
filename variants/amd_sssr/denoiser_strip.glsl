// How the fast form divides its work: a thread denoises a strip of eight pixels, one below the other; eight threads
// denoise a tile; a group denoises eight tiles. Neighbours are fetched from images and not shared: on a CPU shared
// memory costs more than a fetch. Values that the pixels of a strip have in common are computed once.
#ifndef AMD_SSSR_DENOISER_STRIP_GLSL
#define AMD_SSSR_DENOISER_STRIP_GLSL
#include "amd_sssr/denoiser_tile.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

ivec2 strip_start() {
    return tile_start(group_index() * 8u + gl_LocalInvocationID.y) + ivec2(gl_LocalInvocationID.x, 0);
}
#endif
