// Position and direction of a pixel's sample, for passes over a G-buffer.
#include "core/shaders/view.glsl"

// Where the sample of the pixel lies on the un-jittered screen.
vec2 sample_uv(ivec2 pixel) { return (vec2(pixel) + 0.5 + camera.jitter.xy) * camera.extent.zw; }

// Unit, world space, from the camera through the pixel.
vec3 ws_pixel_direction(ivec2 pixel) {
    vec3 vs_point = view_from_screen(sample_uv(pixel), 0.5);
    return mat3(camera.world_from_view) * view_direction(vs_point);
}
