// Which pixels of the G-buffer reflect, and along which ray.
#ifndef COMMON_MIRROR_RAY_GLSL
#define COMMON_MIRROR_RAY_GLSL
#include "core/shaders/view.glsl"

uniform sampler2D depth, geometric_normal, normal, base_color, emission;

// Where a pixel's sample of the G-buffer lies on the un-jittered screen (pixels): at the pixel's centre + jitter.
vec2 screen_from_pixel(ivec2 pixel) { return vec2(pixel) + 0.5 + camera.jitter.xy; }
// The pixel whose sample is nearest to a position on the un-jittered screen (pixels).
ivec2 pixel_from_screen(vec2 position) { return ivec2(floor(position - camera.jitter.xy)); }

// True if the surface that a pixel shows has a specular term.
bool has_specular(ivec2 pixel) {
    return !scene_has_matte || texelFetch(emission, pixel, 0).w > 0.0 || texelFetch(base_color, pixel, 0).w > 0.0;
}

// True for a surface with a specular term at all, and at most of that perceptual roughness.
bool reflects(ivec2 pixel, float roughness_limit) {
    return !is_background(texelFetch(depth, pixel, 0).r) && has_specular(pixel) &&
           texelFetch(normal, pixel, 0).w <= roughness_limit;
}

// View-space position (m) of a pixel's sample at a device depth.
vec3 view_position_at(ivec2 pixel, float device_depth) {
    return view_from_screen(screen_from_pixel(pixel) * camera.extent.zw, device_depth);
}

// View-space position (m) of the surface that a pixel shows.
vec3 view_position(ivec2 pixel) { return view_position_at(pixel, texelFetch(depth, pixel, 0).r); }

// A unit normal of world space in view space.
vec3 view_from_world_normal(vec3 ws_normal) { return normalize(mat3(camera.view_from_world) * ws_normal); }

// Shading normal of a pixel: view space, unit.
vec3 view_normal(ivec2 pixel) { return view_from_world_normal(texelFetch(normal, pixel, 0).xyz); }
// Normal of the triangle that a pixel shows: view space, unit.
vec3 view_geometric_normal(ivec2 pixel) { return view_from_world_normal(texelFetch(geometric_normal, pixel, 0).xyz); }

struct Ray {
    vec3 origin, direction;  // view space (m); view space, unit
};

// From a pixel's surface along the mirrored view direction.
Ray mirror_ray(ivec2 pixel) {
    vec3 origin = view_position(pixel);
    return Ray(origin, reflect(view_direction(origin), view_normal(pixel)));
}
#endif
