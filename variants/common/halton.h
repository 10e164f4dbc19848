#ifndef COMMON_HALTON_H
#define COMMON_HALTON_H
#include "core/shared/language.h"

/// Four words that look random for each four given: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT
/// 9(3), pcg4d.
SHARED uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    for (int round = 0; round < 2; ++round) {
        if (round == 1) v = v ^ (v >> 16u);
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
    }
    return v;
}

/// The digits of `index` in `base` mirrored about the point: Halton 1960, "On the Efficiency of Certain Quasi-Random
/// Sequences of Points in Evaluating Multi-Dimensional Integrals". In [0, 1] for base >= 2.
SHARED float radical_inverse(uint index, uint base) {
    float inverse = 0.0f;
    float digit_weight = 1.0f;
    for (; index > 0u; index /= base) {
        digit_weight /= float(base);
        inverse += float(index % base) * digit_weight;
    }
    return inverse;
}

/// Point `index` of Halton's sequence in bases 2 and 3, in [0, 1)^2, rotated (Cranley and Patterson 1976) by as much as
/// pixel, seed and dimension say: each of them has a sequence of its own, uniform and independent of the others.
SHARED vec2 rotated_halton(uint index, uvec2 pixel, uint seed, uint dimension) {
    uvec4 random = pcg4d(uvec4(pixel.x, pixel.y, seed, dimension));
    vec2 rotation = vec2(float(random.x >> 8u), float(random.y >> 8u)) * (1.0f / 16777216.0f);
    vec2 point = rotation + vec2(radical_inverse(index, 2u), radical_inverse(index, 3u));
    return point - floor(point);
}
#endif
