// How the mips hold colours: times confidence, tone mapped so that one bright pixel does not outshine its neighbours.
#ifndef CONE_MIPS_STORED_COLOR_GLSL
#define CONE_MIPS_STORED_COLOR_GLSL
#include "common/luminance.glsl"

vec3 tone_mapped(vec3 color) { return color / (1.0 + luminance_bt709(color)); }

// Its inverse. In floats luminances above 1e7 are mapped to 1, which stands for that much.
vec3 without_tone_map(vec3 mapped) { return mapped / max(1.0 - luminance_bt709(mapped), 1e-7); }

// What is stored, of a colour and its confidence.
vec4 stored_color(vec4 color) {
    if (average_linear) return vec4(color.a * color.rgb, color.a);
    return vec4(tone_map_colors ? color.a * tone_mapped(color.rgb) : tone_mapped(color.a * color.rgb), color.a);
}

// Colour times confidence, and confidence, of what is stored.
vec4 weighed_color(vec4 stored) {
    if (average_linear) return stored;
    if (!tone_map_colors) return vec4(without_tone_map(stored.rgb), stored.a);
    return stored.a > 0.0 ? vec4(stored.a * without_tone_map(stored.rgb / stored.a), stored.a) : vec4(0.0);
}
#endif
