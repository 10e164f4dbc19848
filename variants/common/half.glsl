// Numbers for targets of 16 bits. Devices differ in what they store for a number above the largest half. The original's
// device stored the largest half; others store infinity; SwiftShader stores NaN, which filters then spread.
#ifndef COMMON_HALF_GLSL
#define COMMON_HALF_GLSL

const float largest_half = 65504.0;

// Four numbers within the range of halves. NaN stays NaN: finite_weights removes it.
vec4 as_halves(vec4 v) {
    return mix(v, sign(v) * largest_half, greaterThan(abs(v), vec4(largest_half)));
}

// A number within the range of halves.
float as_half(float v) { return as_halves(vec4(v)).x; }
#endif
