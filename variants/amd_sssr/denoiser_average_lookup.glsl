// The bilinearly filtered average of the tiles around a pixel.
#ifndef AMD_SSSR_DENOISER_AVERAGE_LOOKUP_GLSL
#define AMD_SSSR_DENOISER_AVERAGE_LOOKUP_GLSL
#include "amd_sssr/denoiser_tile.glsl"

uniform sampler2D average_radiance;

// The extent that the averages are taken to cover (pixels).
vec2 covered_extent() {
    ivec2 extent = ivec2(camera.extent.xy), remainder = extent & 7;
    if (round_up_tiles) return vec2((extent + 7) & ~7);
    // Both axes together, and by 8 instead of to the next multiple of 8: as in the original's GLSL.
    return vec2(remainder == ivec2(0) ? extent : extent + 8);
}

// In the first frame those of the frame before (stale_average) have never been made.
vec3 average_of_listed(vec2 uv) {
    vec2 position = uv * vec2(textureSize(average_radiance, 0)) - 0.5;
    ivec2 first = ivec2(floor(position)), last = textureSize(average_radiance, 0) - 1;
    vec2 share = position - vec2(first);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec3 average = texelFetch(average_radiance, clamp(first + corner, ivec2(0), last), 0).rgb;
        vec2 weights = mix(1.0 - share, share, vec2(corner));
        bool is_listed = average.r < unlisted_average && (!stale_average || camera.frame.w == 1u);
        if (is_listed) sum += vec4(average, 1.0) * weights.x * weights.y;
    }
    return sum.rgb / max(sum.w, 1e-6);
}

vec3 average_around(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5) / covered_extent();
    return fresh_neighborhood ? average_of_listed(uv) : textureLod(average_radiance, uv, 0.0).rgb;
}
#endif
