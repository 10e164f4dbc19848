// The temporal resolve of one pixel.
#ifndef AMD_SSSR_DENOISER_RESOLVE_GLSL
#define AMD_SSSR_DENOISER_RESOLVE_GLSL
#include "amd_sssr/denoiser_average_lookup.glsl"
#include "amd_sssr/denoiser_clip.glsl"
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
