#pragma once
#include "metrics/temporal.h"

#include <array>
#include <span>
#include <string>
#include <vector>

/// Whether a technique changes from frame to frame as the truth does, summed over the steps of a sequence. Constant
/// errors do not count: read the error of single frames, too.
struct FrameDifference {
    /// Adds one step. `masks` select pixels of the later frame, and have the same names in the same order at each step.
    /// Both references may be the same object; their difference is then exactly 0. Fails on different extents.
    void add(const HostImage& test_before, const HostImage& test, const MetricReference& reference_before,
             const MetricReference& reference, std::span<const Mask> masks);

    /// For each mask: frame_difference and frame_difference_relative. Where all references have halves A, B, their
    /// noise is removed: with dA = A_t - A_(t-1), dB likewise, E[(dx - dA)(dx - dB)] = (dx - dtruth)^2, as the noises
    /// of the halves are independent. Intervals hold this noise by noise_half_width(), as in score().
    std::vector<TemporalScore> scores() const;

    struct Sums {
        std::string mask;
        std::array<double, 2> corrected{}, uncorrected{};  ///< squared, and relative
        std::array<NoisyMap, 2> noise;                     ///< noise of these sums; 0 outside the mask
        size_t pixels = 0, left_out = 0;
    };
    std::vector<Sums> sums;  ///< of each mask
    bool has_halves = true;
};
