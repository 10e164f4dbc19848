// The tile of 8x8 pixels that is denoised at once, and the data of a pixel that all passes need.
#ifndef AMD_SSSR_DENOISER_TILE_GLSL
#define AMD_SSSR_DENOISER_TILE_GLSL
#include "amd_sssr/lists.glsl"
#include "common/half.glsl"
#include "common/luminance.glsl"
#include "core/shaders/view.glsl"

const int reach = 4;  // pixels around the tile that its filters see

// With fresh_neighborhood averages of tiles that were not listed are the first of these two numbers, and no other is: the
// largest that all channels of r11g11b10f hold, and the next one.
const float unlisted_average = 64512.0, brightest_average = 62464.0;

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// First pixel of a listed tile; behind the end of the list a place outside of the image, where nothing is stored.
ivec2 tile_start(uint index) {
    if (index >= tile_count) return ivec2(camera.extent.xy);
    return start_of_tile(listed_tile[index]);
}

ivec2 last_pixel() { return ivec2(camera.extent.xy) - 1; }

// 0 outside of the image, which the original leaves to the driver.
vec4 texel(sampler2D image, ivec2 pixel) { return is_on_screen(pixel) ? texelFetch(image, pixel, 0) : vec4(0.0); }

uvec2 packed_halves(vec4 color) { return uvec2(packHalf2x16(color.xy), packHalf2x16(color.zw)); }
vec4 unpacked_halves(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }

bool is_finite(vec3 color) { return !any(isnan(color)) && !any(isinf(color)); }

// Length 0 where there is no surface, as all comparisons with the original's NaN come out.
vec3 unit_or_zero(vec3 v) { return v / max(length(v), 1e-20); }

// The centre of a pixel on the un-jittered screen.
vec2 uv_of(ivec2 pixel) { return (vec2(pixel) + 0.5 + camera.jitter.xy) * camera.extent.zw; }

float floored_luminance(vec3 color) { return max(luma_bt601(color), 0.001); }

// Squared relative change of luminance: what the denoiser calls variance.
float relative_change(vec3 a, vec3 b) {
    float y_a = floored_luminance(a), y_b = floored_luminance(b);
    float change = abs(y_a - y_b) / max(max(y_a, y_b), 0.5);
    return change * change;
}
#endif
