// Writes `specular` by a formula of core/gbuffer/composite.h, and image = lit + specular.
#include "core/shaders/gbuffer/dielectric_f0.glsl"
#include "core/shaders/gbuffer/pixel.glsl"
#include "core/shaders/gbuffer/split_sum.glsl"
#include "core/shared/brdf.h"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D depth;
uniform sampler2D normal;
uniform sampler2D base_color;
uniform sampler2D emission;
uniform sampler2D lit;
uniform sampler2D fallback;
uniform sampler2D radiance;
uniform sampler2D confidence;
layout(push_constant) uniform Push { uint confidence_channel, adds_fresnel; };
layout(rgba32f) uniform writeonly image2D specular;
layout(rgba32f) uniform writeonly image2D image;

vec3 specular_reflectance(ivec2 pixel) {
    vec4 normal_roughness = texelFetch(normal, pixel, 0);
    vec4 color_metalness = texelFetch(base_color, pixel, 0);
    float specular_factor = texelFetch(emission, pixel, 0).w;
    float mu_o = dot(normal_roughness.xyz, -ws_pixel_direction(pixel));
    if (mu_o <= 0.0) return vec3(0.0);  // the path tracer ends such paths
    vec2 ab = split_sum_factors(mu_o, normal_roughness.w);
    vec3 f0 = specular_f0(color_metalness.rgb, color_metalness.w, specular_factor, dielectric_f0_at(pixel));
    return f0 * ab.x + specular_f90(color_metalness.w, specular_factor) * ab.y;
}

// What an engine adds to an image that holds its environment's reflections already.
vec3 added_reflection(ivec2 pixel, vec3 radiance, float weight) {
    vec4 color_metalness = texelFetch(base_color, pixel, 0);
    float mu_o = dot(texelFetch(normal, pixel, 0).xyz, -ws_pixel_direction(pixel));
    return radiance * additive_weight(color_metalness.rgb, color_metalness.w, mu_o, weight);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(image)))) return;
    vec3 reflected = vec3(0.0);
    if (!is_background(texelFetch(depth, pixel, 0).r)) {
        vec3 from_fallback = texelFetch(fallback, pixel, 0).rgb, found = texelFetch(radiance, pixel, 0).rgb;
        float weight = texelFetch(confidence, pixel, 0)[confidence_channel];
        reflected = specular_reflectance(pixel) * (adds_fresnel == 1u ? from_fallback : mix(from_fallback, found, weight));
        if (adds_fresnel == 1u) reflected += added_reflection(pixel, found, weight);
    }
    imageStore(specular, pixel, vec4(reflected, 0.0));
    imageStore(image, pixel, vec4(texelFetch(lit, pixel, 0).rgb + reflected, 0.0));
}
