#ifndef COMMON_HALTON_H
#define COMMON_HALTON_H
#include "core/shared/language.h"

/// Four random-looking words for each four given: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT
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
/// Sequences of Points in Evaluating Multi-Dimensional Integrals". In [0, 1) for base >= 2.
SHARED float radical_inverse(uint index, uint base) {
    float inverse = 0.0f;
    float digit_weight = 1.0f;
    for (; index > 0u; index /= base) {
        digit_weight /= float(base);
        inverse += float(index % base) * digit_weight;
    }
    return min(inverse, 0.99999994f);  // the largest float below 1, to which sums of many digits round
}

/// A point of [0, 1)^2 for every key, as if drawn at random: the upper 24 bits of pcg4d's first two words.
SHARED vec2 random_point(uvec4 key) {
    uvec4 words = pcg4d(key);
    return vec2(float(words.x >> 8u), float(words.y >> 8u)) * (1.0f / 16777216.0f);
}

/// Point `index` of sequence `sequence`, in [0, 1)^2: Halton's in bases 2 and 3, rotated (Cranley and Patterson 1976)
/// by random_point(key) and by steps that depend on `sequence`. A point of one key is uniform and independent of points
/// of other keys. Points of one key fill the square more evenly than random ones, and so do its first sequences
/// together. Their rotations are Roberts' sequence (2018, "The Unreasonable Effectiveness of Quasirandom Sequences"):
/// its irrational steps put no point of one sequence on a point of another, as radical inverses would.
SHARED vec2 rotated_halton(uint index, uint sequence, uvec4 key) {
    vec2 steps = vec2(0.7548777f, 0.5698403f);  // 1 / p and 1 / p^2 of p^3 = p + 1
    vec2 point = random_point(key) + float(sequence) * steps;
    point += vec2(radical_inverse(index, 2u), radical_inverse(index, 3u));
    return point - floor(point);
}
#endif
