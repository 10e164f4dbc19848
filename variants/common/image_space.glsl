// Positions on the screen as marches use them: uv of the G-buffer's images, whose texels hold the samples, and device
// depth. With TAA jitter the samples lie beside the pixel centres, and this screen moves with them.
#ifndef COMMON_IMAGE_SPACE_GLSL
#define COMMON_IMAGE_SPACE_GLSL
#include "core/shaders/view.glsl"

// Jitter in uv.
vec2 jitter_uv() { return camera.jitter.xy * camera.extent.zw; }

// The uv in the images and the device depth of a view-space position.
vec3 image_from_view(vec3 vs_position) { return screen_from_view(vs_position) - vec3(jitter_uv(), 0.0); }
// View-space position (m) of a uv in the images and a device depth.
vec3 view_from_image(vec3 position) { return view_from_screen(position.xy + jitter_uv(), position.z); }

// True if device depth is 1 at the near plane.
bool is_reversed() { return camera.depth.w == 1.0; }
// True if device depth a is farther away than b.
bool is_farther(float a, float b) { return is_reversed() ? a < b : a > b; }
// True if device depth a is nearer than b.
bool is_nearer(float a, float b) { return is_reversed() ? a > b : a < b; }
// The nearer of two device depths.
float nearer_of(float a, float b) { return is_reversed() ? max(a, b) : min(a, b); }
// The farther of two device depths.
float farther_of(float a, float b) { return is_reversed() ? min(a, b) : max(a, b); }

// Where DiligentFX takes the depth buffer for empty: also a surface that close to the far plane.
bool is_far_plane(float device_depth) { return is_reversed() ? device_depth < 1e-6 : device_depth >= 1.0 - 1e-6; }

// True if uv lies outside of the image.
bool is_outside(vec2 uv) { return any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0))); }

const float border_share = 0.05;  // of the screen's height, over which hits fade out towards its border

// A factor of confidence: 1 within the image, 0 at its border.
float border_fade(vec2 uv) {
    vec2 width = border_share * vec2(camera.extent.y * camera.extent.z, 1.0);
    vec2 fade = smoothstep(vec2(0.0), width, uv) * (1.0 - smoothstep(1.0 - width, vec2(1.0), uv));
    return fade.x * fade.y;
}
#endif
