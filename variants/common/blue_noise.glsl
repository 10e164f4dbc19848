// The random numbers of one frame from the table's codes v: frac((v + 1/2) / 256 + start + (frame mod 256) shift +
// rotation), the animation of AMD FidelityFX SSSR 1.5. Numbers are fixed-point in units of 2^-32, whose overflow is the
// frac.
#include "common/halton.h"
layout(push_constant) uniform Shift { uint start, shift_x, shift_y, is_8_bit, is_white; };
uniform sampler2D blue_noise_table;

// A bijection whose output looks random (Wellons 2018, "Prospecting for Hash Functions", lowbias32).
uint hash(uint x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

vec2 numbers_of(uvec2 texel) {
    uvec2 rotation = uvec2(0u);
    uint frame = camera.frame.x & 255u, seed = camera.frame.y;
    if (seed != 0u) {
        rotation = uvec2(hash(3u * seed), hash(3u * seed + 1u));
        texel += uvec2(hash(3u * seed + 2u)) >> uvec2(0u, 16u);
    }
    uvec2 from_white = pcg4d(uvec4(texel, camera.frame.x, seed)).xy;
    uvec2 code = uvec2(texelFetch(blue_noise_table, ivec2(texel & 127u), 0).xy * 255.0 + 0.5);
    uvec2 number = (code << 24) + (1u << 23) + start + frame * uvec2(shift_x, shift_y) + rotation;
    if (is_white != 0u) number = from_white;
    // Rounded here, to the nearest k / 255, rather than by the driver when it stores.
    uvec2 rounded = ((number >> 8) * 255u + (1u << 23)) >> 24;
    return is_8_bit != 0u ? vec2(rounded) / 255.0 : vec2(number >> 8) * (1.0 / 16777216.0);
}
