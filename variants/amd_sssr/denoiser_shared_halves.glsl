// The original's shared memory: the tile and `reach` pixels around it, colours packed as halves.
#ifndef AMD_SSSR_DENOISER_SHARED_HALVES_GLSL
#define AMD_SSSR_DENOISER_SHARED_HALVES_GLSL
#include "amd_sssr/denoiser_moments.glsl"
#include "amd_sssr/denoiser_tile.glsl"

shared uvec2 shared_color[16][16];  // row, column; rgb and one more

void share_color(ivec2 at, vec4 color) { shared_color[at.y][at.x] = packed_halves(color); }
vec4 shared_color_at(ivec2 at) { return unpacked_halves(shared_color[at.y][at.x]); }
#endif
