// The original's shared memory: the tile and `reach` pixels around it, colours packed as halves.
#ifndef AMD_SSSR_DENOISER_SHARED_HALVES_GLSL
#define AMD_SSSR_DENOISER_SHARED_HALVES_GLSL
#include "amd_sssr/denoiser_moments.glsl"
#include "amd_sssr/denoiser_tile.glsl"

shared uvec2 shared_color[16][16];  // row, column; rgb and one more

uvec2 packed_halves(vec4 color) { return uvec2(packHalf2x16(color.xy), packHalf2x16(color.zw)); }
vec4 unpacked_halves(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }

void share_color(ivec2 at, vec4 color) { shared_color[at.y][at.x] = packed_halves(color); }
vec4 shared_color_at(ivec2 at) { return unpacked_halves(shared_color[at.y][at.x]); }

// With finite_neighborhood a neighbour that is not finite counts for nothing: its w is 0.
vec4 neighbor_color(vec3 color) {
    if (!finite_neighborhood) return vec4(color, 1.0);
    return is_finite(color) ? vec4(min(color, largest_half), 1.0) : vec4(0.0);
}

// `at`: of the pixel in shared memory.
Neighborhood neighborhood_at(ivec2 at) {
    vec3 sum = vec3(0.0), sum_of_squares = vec3(0.0);
    float sum_of_weights = 0.0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            vec4 color = shared_color_at(at + ivec2(x, y));
            float weight = kernel_weight(x) * kernel_weight(y) * (finite_neighborhood ? color.w : 1.0);
            sum_of_weights += weight;
            sum += weight * color.rgb;
            sum_of_squares += weight * color.rgb * color.rgb;
        }
    return neighborhood_of(sum, sum_of_squares, sum_of_weights);
}
#endif
