#pragma once
#include "core/shared/language.h"

#include <cmath>
#include <cstdint>

/// What is learnt of a scene is kept in cells of space and of a normal's direction: fine ones, and coarse ones around
/// them for where little was seen.
inline constexpr float finest_cells = 48, coarse_cells = 8;  ///< along the diagonal of the scene

/// The cell of a point (m) with a unit normal; `low`: of the scene's bounds, `cell_size` (m).
inline uint64_t cell_key(vec3 position, vec3 normal, vec3 low, float cell_size) {
    constexpr uint64_t bits = 20;
    uint64_t key = 0;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
        const float at = std::floor((position[i] - low[i]) / cell_size), last = float((1 << bits) - 1);
        key = key << bits | uint64_t(at < 0.0f ? 0.0f : at > last ? last : at);
        if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
    }
    return key << 3 | uint64_t(axis) << 1 | (normal[axis] < 0);
}
