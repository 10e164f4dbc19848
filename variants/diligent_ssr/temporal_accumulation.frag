// Third pass of DiligentFX's denoising: blends with history, from the previous place of the surface or of its mirror
// image.
#include "diligent_ssr/history_search.glsl"
#include "common/luminance.glsl"
#include "common/motion.glsl"
#include "diligent_ssr/unknown_variance.glsl"

layout(location = 0) out vec4 accumulated_radiance;
layout(location = 1) out float accumulated_variance;

uniform sampler2D reprojected_depth, resolved_radiance, resolved_variance, hit_depth;

const float box_deviations = 2.5;  // half the extent of the box that history is clamped to

struct Neighborhood {
    vec4 mean, deviation;
};

// Of 3x3 pixels, those among them that the mask leaves out.
Neighborhood neighborhood_of(ivec2 pixel) {
    vec4 sum = vec4(0.0), squares = vec4(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 texel = clamped_to_screen(pixel + ivec2(i / 3, i % 3) - 1);
        vec4 radiance = texelFetch(resolved_radiance, texel, 0);
        sum += radiance;
        squares += radiance * radiance;
    }
    vec4 mean = sum * (1.0 / 9.0);
    return Neighborhood(mean, sqrt(max(squares * (1.0 / 9.0) - mean * mean, 0.0)));
}

// Pixels of the previous frame, as all that follows. Both take the pixels for unjittered, now and then: what was seen
// through the pixel's centre is looked for, not the sample beside it.
vec2 surface_before(ivec2 pixel) {
    return vec2(pixel) + 0.5 - motion_at(pixel) * camera.extent.xy;
}

// World space, homogeneous.
vec4 mirrored_point(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    float depth = texelFetch(hit_depth, pixel, 0).r;
    if (!linear_hit_depth) return camera.world_from_clip * vec4(uv * 2.0 - 1.0, depth, 1.0);
    vec3 vs_far = view_from_screen(uv, camera.depth.z);
    bool is_orthographic = camera.frame.z == 1u;
    vec3 vs_point = is_orthographic ? vec3(vs_far.xy, -depth) : vs_far * (depth / -vs_far.z);
    return camera.world_from_view * vec4(vs_point, 1.0);
}

// Mirror images move as if the point stood behind the mirror. xy position, z whether there is one.
vec3 mirror_image_before(ivec2 pixel) {
    vec4 ws_position = mirrored_point(pixel);
    vec4 clip = camera.previous_clip_from_world * (ws_position / ws_position.w);
    bool is_valid = !guard_previous_clip || clip.w > 0.0;
    return vec3((clip.xy / clip.w * 0.5 + 0.5) * camera.extent.xy, is_valid ? 1.0 : 0.0);
}

float unlikeness(vec4 radiance, Neighborhood neighborhood) {
    return abs(luma_bt601(radiance.rgb) - luma_bt601(neighborhood.mean.rgb));
}

// The surface's position or its mirror image's, whose history looks more like the pixel's neighborhood now.
vec2 position_before(ivec2 pixel, Neighborhood neighborhood) {
    vec2 surface = surface_before(pixel);
    vec3 image = mirror_image_before(pixel);
    if (image.z == 0.0) return surface;
    bool is_surface = unlikeness(radiance_before(surface), neighborhood) <
                      unlikeness(radiance_before(image.xy), neighborhood);
    return is_surface ? surface : image.xy;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 radiance = texelFetch(resolved_radiance, pixel, 0);
    float variance = texelFetch(resolved_variance, pixel, 0).r;
    accumulated_radiance = radiance;
    accumulated_variance = variance;
    if (!temporal_accumulation) return;

    Neighborhood neighborhood = neighborhood_of(pixel);
    History history = history_near(position_before(pixel, neighborhood),
                                   camera_depth(texelFetch(reprojected_depth, pixel, 0).r));
    bool is_first_frame = camera.frame.w == 0u;
    if (!history.is_found || (is_first_frame && !start_from_black)) {
        accumulated_variance = unknown_variance;
        return;
    }
    vec4 reach = box_deviations * neighborhood.deviation;
    vec4 clamped_history = clamp(history.radiance, neighborhood.mean - reach, neighborhood.mean + reach);
    accumulated_radiance = mix(radiance, clamped_history, temporal_radiance_stability_factor);
    accumulated_variance = mix(variance, variance_before(history.position), temporal_variance_stability_factor);
}
