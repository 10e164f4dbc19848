#ifndef RESOLVES_FIRST_TURN_H
#define RESOLVES_FIRST_TURN_H
#include "variants/common/halton.h"

/// Where a seed starts in an order of pixels that take turns, of which there are 4 or 64: in [0, 64), as if drawn at
/// random. Seeds that took turns themselves would not be independent, and their scatter's estimates of bias and
/// variance would be wrong.
SHARED uint first_turn(uint seed) {
    return pcg4d(uvec4(0xffffffffu, seed, 0u, 0u)).x >> 26u;  // the first word: no pixel of random.glsl
}
#endif
