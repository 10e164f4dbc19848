// What the temporal resolve reads.
#ifndef AMD_SSSR_DENOISER_RESOLVE_INPUTS_GLSL
#define AMD_SSSR_DENOISER_RESOLVE_INPUTS_GLSL
#include "amd_sssr/denoiser_tile.glsl"

uniform sampler2D prefiltered_radiance, prefiltered_variance, reprojected_radiance, sample_count, roughness;
uniform sampler2D traced_radiance;  // the image that this pass overwrites

// A pixel that is not glossy holds its colour before any filter. With fresh_neighborhood it is taken from there, since the
// prefilter has copied it in listed tiles only; and it stays untouched, since other groups may read it.
bool is_final(float alpha) { return fresh_neighborhood && !is_glossy(alpha); }

vec3 filtered_color(ivec2 pixel) {
    if (fresh_neighborhood && !is_glossy(texel(roughness, pixel).r)) return texel(traced_radiance, pixel).rgb;
    return texel(prefiltered_radiance, pixel).rgb;
}
#endif
