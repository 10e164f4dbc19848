// The temporal resolve of one pixel: colour clipping, and the blend of history and present.
#ifndef AMD_SSSR_DENOISER_RESOLVE_GLSL
#define AMD_SSSR_DENOISER_RESOLVE_GLSL
#include "amd_sssr/denoiser_average_lookup.glsl"
#include "amd_sssr/denoiser_moments.glsl"
#include "amd_sssr/denoiser_tile.glsl"

uniform sampler2D prefiltered_radiance, prefiltered_variance, reprojected_radiance, sample_count, roughness;
uniform sampler2D traced_radiance;  // the image that this pass overwrites
uniform writeonly image2D radiance, variance;

// A pixel that is not glossy holds its colour before any filter. With fresh_neighborhood it is taken from there, since
// the prefilter has copied it in listed tiles only; and it stays untouched, since other groups may read it.
bool is_final(float alpha) { return fresh_neighborhood && !is_glossy(alpha); }

// `pixel`: inside of the image.
vec3 filtered_color(ivec2 pixel) {
    if (is_final(texelFetch(roughness, pixel, 0).r)) return texelFetch(traced_radiance, pixel, 0).rgb;
    return texelFetch(prefiltered_radiance, pixel, 0).rgb;
}

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

// `present`: the pixel's filtered colour.
void resolve(ivec2 pixel, vec3 present, Neighborhood around) {
    float alpha = texelFetch(roughness, pixel, 0).r;
    if (is_final(alpha)) return;
    vec4 result = vec4(present, texelFetch(prefiltered_variance, pixel, 0).r);
    bool is_dark = present.r + present.g + present.b < dark_exit_radiance;
    if (temporal_resolve && !no_dark_exit && is_dark) {
        result = vec4(0.0);
    } else if (temporal_resolve && is_glossy(alpha)) {
        float samples = texelFetch(sample_count, pixel, 0).r;
        vec3 history = texelFetch(reprojected_radiance, pixel, 0).rgb;
        result = accumulate(present, result.w, history, samples, average_around(pixel), around);
    }
    imageStore(radiance, pixel, vec4(result.rgb, 0.0));
    imageStore(variance, pixel, vec4(result.w));
}
#endif
