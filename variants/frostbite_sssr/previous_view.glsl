// What the previous camera saw.
#ifndef FROSTBITE_SSSR_PREVIOUS_VIEW_GLSL
#define FROSTBITE_SSSR_PREVIOUS_VIEW_GLSL
#include "common/mirror_ray.glsl"

uniform sampler2D previous_depth;

vec4 world_position(ivec2 pixel) {
    return vec4(world_from_screen(screen_from_pixel(pixel) * camera.extent.zw, texelFetch(depth, pixel, 0).r), 1.0);
}

// From here on all is in the previous camera's view space.
vec3 geometric_normal_before(ivec2 pixel) {
    return mat3(camera.previous_view_from_world) * texelFetch(geometric_normal, pixel, 0).xyz;
}

// `place` on its images (pixels).
vec3 position_before(vec2 place, float device_depth) {
    vec2 uv = (place + camera.jitter.zw) * camera.extent.zw;
    vec4 view = camera.previous_view_from_clip * vec4(uv * 2.0 - 1.0, device_depth, 1.0);
    return view.xyz / view.w;
}

float depth_before(ivec2 texel) { return texelFetch(previous_depth, texel, 0).r; }

// Whether the texel showed, up to 1 % of its distance (ours), the plane through a point. Depth buffers of 16 bits are that
// exact up to 60 m with a near plane at 0.1 m.
bool showed_plane(ivec2 texel, vec3 point, vec3 plane_normal) {
    float device_depth = depth_before(texel);
    if (is_background(device_depth)) return false;
    vec3 shown = position_before(vec2(texel) + 0.5, device_depth);
    return abs(dot(shown - point, plane_normal)) <= 0.01 * -point.z;
}

// Whether that camera saw, at `place` on its images, what `pixel` shows now. Something that moves is taken to keep its
// distance, which motion vectors do not contain.
bool was_seen(ivec2 pixel, vec2 place) {
    vec4 clip = camera.previous_clip_from_world * world_position(pixel);
    ivec2 texel = min(ivec2(place), ivec2(camera.extent.xy) - 1);
    vec3 position = position_before(place, clip.z / clip.w);
    return clip.w > 0.0 && showed_plane(texel, position, geometric_normal_before(pixel));
}
#endif
