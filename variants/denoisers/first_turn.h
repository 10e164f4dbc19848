#ifndef RESOLVES_FIRST_TURN_H
#define RESOLVES_FIRST_TURN_H
#include "variants/common/halton.h"

/// A seed's start, in [0, 64) and random-looking, in an order of 4 or 64 pixels that take turns. If seeds took turns
/// themselves, they would not be independent, and estimates of bias and variance from them would be wrong.
SHARED uint first_turn(uint seed) {
    return pcg4d(uvec4(0xffffffffu, seed, 0u, 0u)).x >> 26u;  // the first word: no pixel of random.glsl
}
#endif
