// World, view, clip and texture coordinates of the current camera; needs the `camera` block, which every pass has.
#ifndef SHADERS_VIEW_GLSL
#define SHADERS_VIEW_GLSL
#include "core/shared/camera.h"

// The uv and device depth of a view-space position in front of the camera.
vec3 screen_from_view(vec3 vs_position) {
    vec4 clip = camera.clip_from_view * vec4(vs_position, 1.0);
    return vec3(clip.xy / clip.w * 0.5 + 0.5, clip.z / clip.w);
}

// View-space position (m) of a uv and a device depth.
vec3 view_from_screen(vec2 uv, float device_depth) {
    vec4 view = camera.view_from_clip * vec4(uv * 2.0 - 1.0, device_depth, 1.0);
    return view.xyz / view.w;
}

// View-space z, which is negative, of a device depth.
float view_z(float device_depth) {
    vec4 view = camera.view_from_clip * vec4(0.0, 0.0, device_depth, 1.0);
    return view.z / view.w;
}

// Distance from the camera plane (m) of a device depth, by the projection, not by its inverse as view_z(): edges of a flat
// surface are found by differences that are as small as the rounding.
float camera_depth(float device_depth) {
    mat4 clip_from_view = camera.clip_from_view;
    return (device_depth * clip_from_view[3][3] - clip_from_view[3][2]) /
           (device_depth * clip_from_view[2][3] - clip_from_view[2][2]);
}

// World-space position (m) of a uv and a device depth.
vec3 world_from_screen(vec2 uv, float device_depth) {
    return (camera.world_from_view * vec4(view_from_screen(uv, device_depth), 1.0)).xyz;
}

// True where the depth buffer still holds its clear value: nothing was drawn there.
bool is_background(float device_depth) { return device_depth == camera.depth.z; }

// False for the threads of a workgroup that lie beyond the image.
bool is_on_screen(ivec2 pixel) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(camera.extent.xy)));
}

// Unit vector from the camera towards the view-space position.
vec3 view_direction(vec3 vs_position) {
    return camera.frame.z == 1u ? vec3(0.0, 0.0, -1.0) : normalize(vs_position);
}
#endif
