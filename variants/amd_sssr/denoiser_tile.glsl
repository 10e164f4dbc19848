// The tile of 8x8 pixels that a group denoises, and what all passes ask of a pixel.
#ifndef AMD_SSSR_DENOISER_TILE_GLSL
#define AMD_SSSR_DENOISER_TILE_GLSL
#include "core/shaders/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430) readonly buffer tile_list { uint listed_tiles[]; };

const int reach = 4;  // pixels around the tile that its filters see
const float largest_half = 65504.0;

ivec2 tile_start() {
    uint word = listed_tiles[gl_WorkGroupID.x];
    return ivec2(word & 0xffffu, word >> 16);
}

bool is_in_image(ivec2 pixel) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(camera.extent.xy)));
}

// 0 outside of the image, which the original leaves to the driver.
vec4 texel(sampler2D image, ivec2 pixel) { return is_in_image(pixel) ? texelFetch(image, pixel, 0) : vec4(0.0); }

bool is_glossy(float alpha) { return alpha < roughness_threshold_alpha; }
bool is_mirror(float alpha) { return alpha < 1e-4; }  // Denoiser 1.3, is_mirror_reflection

bool is_finite(vec3 color) { return !any(isnan(color)) && !any(isinf(color)); }

// Length 0 where there is no surface, as all comparisons with the original's NaN come out.
vec3 unit_or_zero(vec3 v) { return v / max(length(v), 1e-20); }

// View-space distance along the viewing axis (m).
float linear_depth(vec2 uv, float device_depth) { return abs(view_from_screen(uv, device_depth).z); }

// The centre of a pixel on the un-jittered screen.
vec2 uv_of(ivec2 pixel) { return (vec2(pixel) + 0.5 + camera.jitter.xy) * camera.extent.zw; }

float luminance(vec3 color) { return max(dot(color, vec3(0.299, 0.587, 0.114)), 0.001); }

// Squared relative change of luminance: what the denoiser calls variance.
float relative_change(vec3 a, vec3 b) {
    float y_a = luminance(a), y_b = luminance(b);
    float change = abs(y_a - y_b) / max(max(y_a, y_b), 0.5);
    return change * change;
}
#endif
