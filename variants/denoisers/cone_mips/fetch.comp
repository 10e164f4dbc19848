// Reads the mips for each pixel: with half_resolution at the four traced pixels around it, each at its own level.
#include "common/mirror_ray.glsl"
#include "denoisers/cone_mips/stored_color.glsl"
#include "denoisers/traced_pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D own_radiance, reflection_mips, cone_level;
uniform writeonly image2D reflections;

// Of colour times confidence, and confidence.
vec4 with_confidence(vec4 weighed) {
    return weighed.a > 1e-6 ? vec4(weighed.rgb / weighed.a, min(weighed.a, 1.0)) : vec4(0.0);
}

// A mirror shows its ray as it is, which no tone map or sampler rounds.
vec4 at_full_resolution(ivec2 pixel) {
    float level = texelFetch(cone_level, pixel, 0).r;
    if (level == 0.0) return texelFetch(own_radiance, pixel, 0);
    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    return with_confidence(weighed_color(textureLod(reflection_mips, uv, level)));
}

// Natural logarithm of the weight of a traced pixel, bilinear weight apart.
float likeness(ivec2 pixel, ivec2 traced) {
    ivec2 other = traced_pixel(traced, camera.frame.x);
    vec4 surface = texelFetch(normal, pixel, 0), other_surface = texelFetch(normal, other, 0);
    float by_depth = depth_phi * abs(texelFetch(depth, pixel, 0).r - texelFetch(depth, other, 0).r);
    float by_normal = normal_phi * clamp(1.0 - dot(surface.xyz, other_surface.xyz), 0.0, 1.0);
    return -(by_depth + by_normal + roughness_phi * abs(surface.w - other_surface.w));
}

vec4 at_half_resolution(ivec2 pixel) {
    ivec2 extent = traced_extent(), corner = exact_upsampling ? (pixel - 1) >> 1 : max(pixel - 1, 0) / 2;
    vec2 share = 1.0 - fract((vec2(pixel) + 0.5) / 2.0);
    vec2 texel_size = exact_upsampling ? 1.0 / vec2(extent) : 2.0 * camera.extent.zw;
    ivec2 traced[4];
    float alike[4], most = -3.402823466e38;
    for (int i = 0; i < 4; ++i) {
        traced[i] = clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), extent - 1);
        alike[i] = likeness(pixel, traced[i]);
        most = max(most, alike[i]);
    }
    vec4 sum = vec4(0.0);
    float weight_sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 weights = mix(1.0 - share, share, vec2(i & 1, i >> 1));
        float weight = weights.x * weights.y * exp(alike[i] - (exact_upsampling ? most : 0.0));
        vec2 uv = (vec2(traced[i]) + 0.5) * texel_size;
        float level = texelFetch(cone_level, traced[i], 0).r;
        sum += weight * weighed_color(textureLod(reflection_mips, uv, level));
        weight_sum += weight;
    }
    return weight_sum > 0.0 ? with_confidence(sum / weight_sum) : vec4(0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 result = vec4(0.0);
    if (reflects(pixel, max_roughness)) {
        result = half_resolution ? at_half_resolution(pixel) : at_full_resolution(pixel);
        result.a *= 1.0 - smoothstep(fade_begin, fade_begin + fade_width, texelFetch(normal, pixel, 0).w);
    }
    imageStore(reflections, pixel, result);
}
