// The prefilter: neighbours count by how close their normal and depth are to the pixel's and how close their colour is
// to the tile's average.
#ifndef AMD_SSSR_DENOISER_PREFILTER_GLSL
#define AMD_SSSR_DENOISER_PREFILTER_GLSL
#include "amd_sssr/denoiser_average_lookup.glsl"
#include "amd_sssr/denoiser_moments.glsl"

uniform sampler2D radiance, variance, depth, normal, roughness;
uniform writeonly image2D prefiltered_radiance, prefiltered_variance;

// The first points of the Halton sequence (2, 3) stretched to [-3, 3] (Denoiser 1.3, prefilter).
const ivec2 filter_taps[15] = ivec2[](ivec2(0, 1), ivec2(-2, 1), ivec2(2, -3), ivec2(-3, 0), ivec2(1, 2),
                                      ivec2(-1, -2), ivec2(3, 0), ivec2(-3, 3), ivec2(0, -3), ivec2(-1, -1),
                                      ivec2(2, 1), ivec2(-2, -2), ivec2(1, 0), ivec2(0, 2), ivec2(3, -1));

struct Neighbor {
    vec3 color;
    float is_counted;  // 1; 0 for a colour that is not finite, with finite_neighborhood
    vec3 normal;
    float variance;
    float depth;  // m
};

struct Filter {
    Neighbor center;
    vec3 average;
    float strength;
    vec3 color_sum;
    float variance_sum, weight_sum;
};

float color_weight(Filter f, vec3 color) {
    float falloff = radiance_weight_bias + f.center.variance * radiance_weight_variance_k;
    return max(exp(-falloff * length(f.average - color)), 0.01);
}

Filter start_filter(Neighbor center, vec3 average) {
    Filter f;
    f.center = center;
    f.average = average;
    f.strength = max(prefilter_variance_bias, 1.0 - exp(-prefilter_variance_weight * center.variance));
    f.weight_sum = color_weight(f, center.color) * (finite_neighborhood ? center.is_counted : 1.0);
    f.color_sum = f.weight_sum * center.color;
    f.variance_sum = f.weight_sum * f.weight_sum * center.variance;
    return f;
}

void add_tap(inout Filter f, Neighbor neighbor) {
    float apart = abs(f.center.depth - neighbor.depth);
    float scale = relative_depth_weight ? 1.0 / f.center.depth : f.center.depth;
    float weight = pow(max(dot(f.center.normal, neighbor.normal), 0.0), prefilter_normal_sigma) *
                   exp(-prefilter_depth_sigma * scale * apart) * color_weight(f, neighbor.color) * f.strength;
    if (finite_neighborhood) weight *= neighbor.is_counted;
    f.color_sum += weight * neighbor.color;
    f.variance_sum += weight * weight * neighbor.variance;
    f.weight_sum += weight;
}

// rgb and, in w, variance.
vec4 filter_result(Filter f) {
    return vec4(f.color_sum / f.weight_sum, f.variance_sum / (f.weight_sum * f.weight_sum));
}

void store_filtered(ivec2 pixel, Filter filtered) {
    Neighbor center = filtered.center;
    float alpha = texelFetch(roughness, pixel, 0).r;
    bool is_filtered = prefilter && center.variance > 0.0 && is_glossy(alpha) && !is_mirror(alpha);
    vec4 result = is_filtered ? filter_result(filtered) : vec4(center.color, center.variance);
    imageStore(prefiltered_radiance, pixel, vec4(result.rgb, 0.0));
    imageStore(prefiltered_variance, pixel, vec4(result.w));
}
#endif
