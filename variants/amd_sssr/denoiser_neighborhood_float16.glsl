// Moments of the 9x9 pixels in shared memory around one, summed in half floats, of which GPUs take two at a time.
// Differences from the pixel are summed: its brightness, and rounding of squares of nearly equal colours, then do not
// matter. Weights are an eighth. Squares of differences above 145 overflow halves: variance is then infinite, and
// history is not clipped. Squares of differences below 0.15 may be denormals. If a device keeps denormals, variance is
// off by less than the square of the 0.001 that clip_to_box() adds. If it flushes them, variance is too small.
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
    f16vec3 center = shared_half_color_at(at).rgb;
    f16vec4 difference_and_weight = f16vec4(0.0);
    f16vec3 square = f16vec3(0.0);
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            f16vec4 color = shared_half_color_at(at + ivec2(x, y));
            f16vec3 difference = color.rgb - center;
            float16_t weight = float16_t(kernel_weight(x) * kernel_weight(y) / 8.0);
            if (finite_neighborhood) weight *= color.w;
            f16vec3 weighted = weight * difference;
            difference_and_weight += f16vec4(weighted, weight);
            square += weighted * difference;
        }
    Moments sum = Moments(vec3(difference_and_weight.rgb), vec3(square), float(difference_and_weight.w));
    Neighborhood around = neighborhood_of(sum);
    around.mean += vec3(center);
    return around;
}
#endif
