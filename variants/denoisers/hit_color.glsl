// Where hits take their colour from. Needs the parameter previous_frame.
#ifndef DENOISERS_HIT_COLOR_GLSL
#define DENOISERS_HIT_COLOR_GLSL
#include "common/motion.glsl"

// Where the lit image shows what `pixel` shows: as `motion` is without jitter, both frames' are added.
vec2 color_uv_of(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    if (!previous_frame) return uv;
    vec2 moved = motion_at(pixel) - (camera.jitter.xy - camera.jitter.zw) * camera.extent.zw;
    // No branch on whether there is a previous frame: for such a branch lavapipe 22.3 compiles the shader anew at every
    // dispatch, and never frees it.
    return uv - float(camera.frame.w) * moved;
}

bool lies_on_image(vec2 uv) { return all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0))); }
#endif
