// Statistics of the rays around a pixel.
#ifndef RECURRENT_BLUR_RAY_STATISTICS_GLSL
#define RECURRENT_BLUR_RAY_STATISTICS_GLSL
#include "common/luminance.glsl"
#include "common/mirror_ray.glsl"

uniform sampler2D own_radiance, own_length;

ivec2 clamped_to_screen(ivec2 pixel) { return clamp(pixel, ivec2(0), ivec2(camera.extent.xy) - 1); }

// Colour times confidence, confidence: what is averaged, so that half a hit and half a miss are half as much.
vec4 traced_color(ivec2 pixel) {
    vec4 own = texelFetch(own_radiance, pixel, 0);
    return vec4(own.rgb * own.a, own.a);
}

float luminance_of(vec4 color) { return luminance_bt709(color.rgb); }

// Of colours that are compared: bright ones count less.
vec4 damped(vec4 color) { return color / (1.0 + 10.0 * flicker_suppression * luminance_of(color)); }
#endif
