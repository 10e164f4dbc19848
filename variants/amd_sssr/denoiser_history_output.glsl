// The output of the reprojection, and the weights of pixels in the averages of 8x8 tiles.
#ifndef AMD_SSSR_DENOISER_HISTORY_OUTPUT_GLSL
#define AMD_SSSR_DENOISER_HISTORY_OUTPUT_GLSL
#include "amd_sssr/denoiser_history.glsl"

uniform writeonly image2D reprojected_radiance, variance, sample_count, average_radiance;

// rgb times weight, weight; 0 where the pixel must not count.
vec4 weighted_for_average(ivec2 pixel, vec3 color) {
    if (finite_neighborhood && is_finite(color)) color = min(color, largest_half);
    float weight = max(exp(-avg_radiance_luminance_weight * floored_luminance(color)), 0.01);
    bool counts = is_on_screen(pixel) && is_finite(color * weight) && weight <= 1e3;
    return counts ? vec4(color * weight, weight) : vec4(0.0);
}

vec3 average_of(vec4 weighted_sum) { return weighted_sum.rgb / max(weighted_sum.w, 1e-3); }

// Returns what the pixel adds to its tile's average.
vec3 store_history(ivec2 pixel, float alpha, vec3 color, History history) {
    vec3 found = vec3(0.0), averaged = color;
    float samples = 1.0, change = 1.0;
    if (is_usable(history)) {
        found = history.radiance;
        averaged = mix(color, found, average_reprojected_share);
        samples = textureLod(previous_sample_count, history.uv, 0.0).r * history.factor + 1.0;
        samples = min(samples, longest_history(alpha));
        float before = textureLod(previous_variance, history.uv, 0.0).r;
        change = mix(relative_change(color, found), before, running_variance ? 1.0 - 1.0 / samples : 1.0 / samples);
    }
    imageStore(reprojected_radiance, pixel, vec4(found, 0.0));
    imageStore(variance, pixel, vec4(change));
    imageStore(sample_count, pixel, vec4(samples));
    return averaged;
}

void store_average(ivec2 tile, vec4 weighted_sum) {
    vec3 average = average_of(weighted_sum);
    if (fresh_neighborhood) average = min(average, vec3(brightest_average));
    imageStore(average_radiance, tile, vec4(average, 0.0));
}
#endif
