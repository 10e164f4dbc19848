#pragma once
#include "metrics/temporal.h"

#include <span>
#include <string>
#include <vector>

/// How much of the truth's earlier images remains in the frames of a sequence in which the truth changes.
struct GhostShare {
    /// Weight of each new frame in the image of earlier frames, as histories of techniques have it (Karis 2014, "High
    /// Quality Temporal Supersampling": about a tenth).
    static constexpr float new_frame = 0.1f;

    /// Adds one frame. `before` and `now`: the references of the previous frame and of this one; `masks` as
    /// FrameDifference::add() has them. Fails on different extents.
    void add(const HostImage& test, const MetricReference& before, const MetricReference& now,
             std::span<const Mask> masks);

    /// ghost_share of each mask:
    ///
    ///     sum of (x_t - r_t) (h_t - r_t) / sum of (h_t - r_t)^2,    h_1 = r_0,    h_t = 0.9 h_(t-1) + 0.1 r_(t-1)
    ///
    /// 0: frames hold nothing of earlier images. 1: they are a history of the truth. Both sums are over frames, pixels
    /// and channels. Products of independent halves of references keep them free of noise; intervals are those of
    /// Sums::noise() by noise_half_width(). No value where the change is below four times 1.96 standard errors of its
    /// own. Empty where the truth never changes.
    std::vector<TemporalScore> scores() const;

    struct Sums {
        std::string mask;
        double remaining = 0, change = 0;        ///< the two sums, per channel
        NoisyMap remaining_noise, change_noise;  ///< 0 outside the mask
        size_t pixels = 0, left_out = 0;

        /// The noise of the share, times `change`: of remaining - share * change, to first order.
        NoisyMap noise() const;
    };
    std::vector<Sums> sums;  ///< of each mask
    bool has_halves = true;

private:
    HostImage earlier_, earlier_a_, earlier_b_;  ///< h_t of references and of both halves
};
