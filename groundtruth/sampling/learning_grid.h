#pragma once
#include "core/shared/language.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// The cells for values that are learnt of a scene: cubes over the scene's bounds, times the six directions nearest to
/// the normal. Coarser cells around them serve where little was observed.
struct LearningGrid {
    LearningGrid() = default;
    /// `low`, `high`: bounds of the scene (m). A scene in one point has no cells.
    LearningGrid(vec3 low, vec3 high) : low_(low) {
        if (!(dot(high - low, high - low) > 0)) return;
        per_metre_ = cubes / std::sqrt(dot(high - low, high - low));
        for (int i = 0; i < 3; ++i) extent_[i] = uint32_t((high[i] - low[i]) * per_metre_) + 1;
    }

    /// The number of cells; 0: nothing can be learnt.
    size_t size() const { return size_t(extent_[0]) * extent_[1] * extent_[2] * 6; }

    /// The cell of a point (m) with a unit normal, on the side where light arrives; the nearest one for points outside.
    /// Any number if there are no cells.
    size_t index(vec3 position, vec3 normal) const {
        size_t cube = 0;
        int axis = 0;
        for (int i = 0; i < 3; ++i) {
            const float at = (position[i] - low_[i]) * per_metre_;
            const size_t inside = at > 0.0f ? size_t(std::min(at, float(extent_[i] - 1))) : 0;  // 0 if not a number
            cube = cube * extent_[i] + inside;
            if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
        }
        return cube * 6 + size_t(axis) * 2 + (normal[axis] < 0);
    }

    /// The coarser cell around a cell; its index is at most `index`.
    size_t coarse_index(size_t index) const {
        const size_t cube = index / 6;
        size_t wide = cube / extent_[2] / extent_[1] / coarse_width;
        wide = wide * extent_[1] + cube / extent_[2] % extent_[1] / coarse_width;
        wide = wide * extent_[2] + cube % extent_[2] / coarse_width;
        return wide * 6 + index % 6;
    }

private:
    static constexpr float cubes = 48;         ///< along the diagonal of the scene: at most 22000 fill it
    static constexpr size_t coarse_width = 6;  ///< of the wider cubes, in cubes

    vec3 low_{0.0f};
    float per_metre_ = 0.0f;
    uint32_t extent_[3] = {};
};
