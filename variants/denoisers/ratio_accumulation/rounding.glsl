// Numbers for images of 16 bits, where float_histories is false. Devices round what they store to the nearest number or
// towards 0, and a mean of many frames would stand still or grow dark. So this rounds up and down, as often as the mean
// of the results is the number.
#ifndef RATIO_ACCUMULATION_ROUNDING_GLSL
#define RATIO_ACCUMULATION_ROUNDING_GLSL
#include "common/half.glsl"

const uint dropped_bits = 13u;  // of a float, that a half lacks

// In the upper bits of a word: evenly spread over the frames of each pixel, and over neighbours. The factors are 2^32
// times the powers of the inverse of the root of x^4 = x + 1 (Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences").
uint rounding_noise(ivec2 pixel) {
    return uint(pixel.x) * 0xd1b54a32u + uint(pixel.y) * 0xabc98388u + camera.frame.x * 0x8cb92ba7u;
}

// Not for negative numbers. The largest half does not overflow.
vec4 rounded(vec4 v, uint noise) {
    if (float_histories) return v;
    const uint dropped = (1u << dropped_bits) - 1u;
    uvec4 bits = floatBitsToUint(min(v, vec4(largest_half))) + (noise >> (32u - dropped_bits));
    return uintBitsToFloat(bits & ~dropped);
}
#endif
