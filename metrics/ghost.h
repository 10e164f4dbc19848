#pragma once
#include "metrics/temporal.h"

#include <span>
#include <vector>

inline constexpr size_t least_ghost_frames = 8;  ///< two make the plateau

/// How long the old image remains after a change, under one mask.
struct Ghost {
    TemporalScore ghost_length, settling_length;  ///< frames
    std::vector<double>
        share;  ///< per frame, the share g of the old image that remains, 1 to 0; empty if no change is measurable
    std::vector<double> error;  ///< mean squared error of each frame against the state after the change, radiance^2
};

/// `frames`: static frames from the change on, the first one showing the new state; `before` and `after`: the
/// references of both states from the same camera. A frame's index is its age.
///
/// ghost_length: the number of frames that show more than 5 % of the old image. settling_length: the age from which on
/// the squared error is within 5 % of its plateau. metrics/README.md ("Ghosts") has the formulas and the cases without
/// a value. Both are free of reference noise; `high` is missing if the interval is unbounded.
///
/// Fails below least_ghost_frames, or on different extents.
std::vector<Ghost> ghost_scores(std::span<const HostImage> frames, const MetricReference& before,
                                const MetricReference& after, std::span<const Mask> masks);
