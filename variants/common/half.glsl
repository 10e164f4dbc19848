// Numbers for targets of 16 bits. What a device stores of one above the largest half is up to it: that half, as on the
// device that the original was recorded on; infinity; or, as SwiftShader, not a number, which then spreads by the filters.
#ifndef COMMON_HALF_GLSL
#define COMMON_HALF_GLSL

const float largest_half = 65504.0;

// NaN stays NaN: finite_weights removes it.
vec4 as_halves(vec4 v) {
    return mix(v, sign(v) * largest_half, greaterThan(abs(v), vec4(largest_half)));
}
float as_half(float v) { return as_halves(vec4(v)).x; }
#endif
