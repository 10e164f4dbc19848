#pragma once
#include "metrics/temporal.h"

#include <span>
#include <vector>

inline constexpr size_t least_ghost_frames = 8;  ///< two make the plateau

/// How long the old image lingers after a change, under one mask.
struct Ghost {
    TemporalScore ghost_length, settling_length;  ///< frames
    std::vector<double> share;  ///< g of each frame: 1: the old image, 0: none of it; empty if no change can be told
    std::vector<double> error;  ///< mean squared error of each frame against the state after the change, radiance^2
};

/// `frames` are those from the change on, the first one showing the new state, all of it standing still; `before` and
/// `after` the references of both states from the same camera. A frame's index in them is its age.
///
/// ghost_length: the number of frames that still show the old image, the least age from which on |g| < 0.05, where
///     g_t = <x_t - x_end, R_before - R_after> / <R_before - R_after, R_before - R_after>
/// summed over the mask's pixels and channels, and x_end is the mean of the last quarter of the frames: the technique's
/// own plateau, so that what it gets wrong for good does not count as ghost. Being linear in x_t, it averages noise
/// away in place of counting it as error. It is a share of what the truth changes by: a technique that shows little of
/// the change at all has little to linger, so read it beside the error of the state after.
///
/// settling_length: the least age from which on the squared error has covered 95 % of its way from the first frame's to
/// its plateau's, |e_t - e_end| < 0.05 |e_0 - e_end|. It also sees what is not the old image: the noise of a history
/// that starts anew. For an exponential history it is half as long as ghost_length, as errors are squared.
///
/// Reference noise is taken out of sums with the halves: <R_before - R_after> of A times that of B, (x - A)(x - B).
/// Intervals: `low` and `high` are the lengths where the curve minus, and plus, the half-width of its jackknife over
/// tiles stays below the limit; `high` is missing if it does not.
///
/// No length is given: if it is beyond half of the frames, since the plateau is then none (for an exponential decay,
/// one just within is too short by 5 %); if the change's energy is less than four times the half-width of its noise,
/// which would make the scale of g uncertain by a quarter; or if the frames' own noise hides the decay.
///
/// Fails below least_ghost_frames, or on different extents.
std::vector<Ghost> ghost_scores(std::span<const HostImage> frames, const MetricReference& before,
                                const MetricReference& after, std::span<const Mask> masks);
