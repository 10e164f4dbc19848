// The averages of 8x8 tiles: how a pixel counts in one, and how they are looked up.
#ifndef AMD_SSSR_DENOISER_AVERAGE_GLSL
#define AMD_SSSR_DENOISER_AVERAGE_GLSL
#include "amd_sssr/denoiser_tile.glsl"

// rgb times weight, weight; 0 where the pixel must not count.
vec4 weighted_for_average(ivec2 pixel, vec3 color) {
    if (finite_neighborhood && is_finite(color)) color = min(color, largest_half);
    float weight = max(exp(-avg_radiance_luminance_weight * luminance(color)), 0.01);
    bool counts = is_in_image(pixel) && is_finite(color * weight) && weight <= 1e3;
    return counts ? vec4(color * weight, weight) : vec4(0.0);
}

vec3 average_of(vec4 weighted_sum) { return weighted_sum.rgb / max(weighted_sum.w, 1e-3); }
#endif
