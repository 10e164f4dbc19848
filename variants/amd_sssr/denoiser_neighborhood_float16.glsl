// Moments of the 9x9 pixels in shared memory around one, summed in half floats, of which GPUs take two at a time.
// Weights are a 32nd, so that sums of colours stay below the largest half; squares of colours above 290 do not, and the
// variance is infinite there: history is not clipped.
#ifndef AMD_SSSR_DENOISER_NEIGHBORHOOD_FLOAT16_GLSL
#define AMD_SSSR_DENOISER_NEIGHBORHOOD_FLOAT16_GLSL
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#include "amd_sssr/denoiser_shared_halves.glsl"

f16vec4 shared_half_color_at(ivec2 at) {
    uvec2 halves = shared_color[at.y][at.x];
    return f16vec4(unpackFloat2x16(halves.x), unpackFloat2x16(halves.y));
}

// `at`: of the pixel in shared memory.
Neighborhood neighborhood_at(ivec2 at) {
    f16vec4 color_and_weight = f16vec4(0.0);
    f16vec3 square = f16vec3(0.0);
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            f16vec4 color = shared_half_color_at(at + ivec2(x, y));
            float16_t weight = float16_t(kernel_weight(x) * kernel_weight(y) / 32.0);
            if (finite_neighborhood) weight *= color.w;
            f16vec3 weighted = weight * color.rgb;
            color_and_weight += f16vec4(weighted, weight);
            square += weighted * color.rgb;
        }
    return neighborhood_of(Moments(vec3(color_and_weight.rgb), vec3(square), float(color_and_weight.w)));
}
#endif
