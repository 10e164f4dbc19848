// Colour clipping and the blend of history and present.
#ifndef AMD_SSSR_DENOISER_CLIP_GLSL
#define AMD_SSSR_DENOISER_CLIP_GLSL
#include "amd_sssr/denoiser_moments.glsl"

// Moves `color` along the line to the box's centre until it is inside (Karis 2014, "High Quality Temporal
// Supersampling"; Pedersen 2016, "Temporal Reprojection Anti-Aliasing in INSIDE").
vec3 clip_to_box(vec3 color, vec3 center, vec3 half_extent) {
    vec3 offset = color - center;
    vec3 excess = abs(offset / (half_extent + 0.001));
    float greatest = max(max(excess.x, excess.y), excess.z);
    return greatest > 1.0 ? center + offset / greatest : color;
}

// Radiance and, in w, variance that the frame ends with.
vec4 accumulate(vec3 present, float variance_now, vec3 history, float samples, vec3 average, Neighborhood around) {
    vec3 half_extent = (sqrt(around.variance) + length(around.mean - average)) * clip_scale * temporal_stability_factor;
    history = clip_to_box(history, mix(around.mean, average, average_pull), half_extent);
    present = clip_to_box(mix(present, average, 1.0 / max(samples + 1.0, 1.0)), average, half_extent);
    float share_of_history = 1.0 - 1.0 / max(samples, 1.0);
    vec3 radiance_out = mix(present, history, share_of_history);
    float variance_out = mix(relative_change(radiance_out, history), variance_now, share_of_history);
    bool is_valid = is_finite(radiance_out) && !isnan(variance_out) && !isinf(variance_out);
    return is_valid ? vec4(radiance_out, variance_out) : vec4(0.0);
}
#endif
