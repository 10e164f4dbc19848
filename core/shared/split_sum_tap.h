#ifndef SHARED_SPLIT_SUM_TAP_H
#define SHARED_SPLIT_SUM_TAP_H
#include "core/shared/language.h"

/// The four texels of split_sum_table() around a point: column = mu_o, row = perceptual roughness, clamped at the
/// edges.
struct SplitSumTap {
    uvec2 first, last;
    vec2 fraction;  ///< of `last`
};

SHARED SplitSumTap split_sum_tap(float mu_o, float roughness, uint size) {
    float end = float(size) - 1.0f;
    float x = clamp(mu_o * float(size) - 0.5f, 0.0f, end);
    float y = clamp(roughness * float(size) - 0.5f, 0.0f, end);
    SplitSumTap tap;
    tap.first = uvec2(uint(x), uint(y));
    tap.last = uvec2(min(tap.first.x + 1u, size - 1u), min(tap.first.y + 1u, size - 1u));
    tap.fraction = vec2(x - floor(x), y - floor(y));
    return tap;
}
#endif
