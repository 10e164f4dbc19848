// The prefilter's inputs and outputs.
#ifndef AMD_SSSR_DENOISER_PREFILTER_GLSL
#define AMD_SSSR_DENOISER_PREFILTER_GLSL
#include "amd_sssr/denoiser_average_lookup.glsl"
#include "amd_sssr/denoiser_moments.glsl"
#include "amd_sssr/denoiser_prefilter_weights.glsl"

uniform sampler2D radiance, variance, depth, normal, roughness;
uniform writeonly image2D prefiltered_radiance, prefiltered_variance;

void store_filtered(ivec2 pixel, Filter filtered) {
    Neighbor center = filtered.center;
    float alpha = texelFetch(roughness, pixel, 0).r;
    bool is_filtered = prefilter && center.variance > 0.0 && is_glossy(alpha) && !is_mirror(alpha);
    vec4 result = is_filtered ? filter_result(filtered) : vec4(center.color, center.variance);
    imageStore(prefiltered_radiance, pixel, vec4(result.rgb, 0.0));
    imageStore(prefiltered_variance, pixel, vec4(result.w));
}
#endif
