// Blends each pixel's reflection with the previous frame's reflection.
#include "common/half.glsl"
#include "frostbite_sssr/history.glsl"
#include "frostbite_sssr/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D resolved_radiance, resolved_length;
uniform writeonly image2D accumulated, reflections;

// What is composited is colour times confidence, and so is what is averaged: half a hit and half a miss are half as
// much.
vec4 weighed_color(ivec2 pixel) {
    vec4 color = texelFetch(resolved_radiance, pixel, 0);
    return vec4(color.rgb * color.a, color.a);
}

// Into the box of the 3x3 neighbours' colours, expanded about its centre.
vec4 clamped_to_neighborhood(ivec2 pixel, vec4 history) {
    vec4 low = weighed_color(pixel), high = low;
    for (int i = 0; i < 9; ++i) {
        ivec2 neighbor = clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), ivec2(camera.extent.xy) - 1);
        vec4 color = weighed_color(neighbor);
        low = min(low, color);
        high = max(high, color);
    }
    vec4 center = 0.5 * (low + high), reach = 0.5 * clamp_scale * (high - low);
    return clamp(history, center - reach, center + reach);
}

vec4 blended(ivec2 pixel, vec4 color) {
    const bool misses_show_nothing = misses == 0u;
    float ray_length = texelFetch(resolved_length, pixel, 0).r;
    bool is_first_frame = camera.frame.w == 0u;
    bool is_rejected = reject_without_hits && misses_show_nothing && ray_length == 0.0;
    if (is_first_frame || is_rejected) return color;
    History history = history_at(pixel, reflection_before(pixel, ray_length));
    if (!history.is_found) return color;
    if (neighborhood_clamp) history.color = clamped_to_neighborhood(pixel, history.color);
    return mix(color, history.color, history_weight);
}

// The compositor multiplies by both.
vec4 without_factors(ivec2 pixel, vec4 color) {
    if (color.a <= 0.0) return vec4(0.0);
    vec3 radiance = color.rgb / color.a;
    if (reflectance_after_filter) return vec4(radiance, color.a);
    vec3 factor = reflectance(surface_of(pixel));
    return vec4(mix(vec3(0.0), radiance / max(factor, vec3(1e-37)), greaterThan(factor, vec3(0.0))), color.a);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 color = no_reflection;
    if (reflects(pixel, max_roughness)) {
        color = weighed_color(pixel);
        if (temporal_filter) color = blended(pixel, color);
    }
    imageStore(accumulated, pixel, float_histories ? color : min(color, largest_half));
    imageStore(reflections, pixel, without_factors(pixel, color));
}
