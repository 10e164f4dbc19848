#pragma once
#include "metrics/seed_pairs.h"
#include "metrics/statistics/estimates.h"
#include "metrics/temporal.h"

#include <span>
#include <vector>

/// Frames of a shot where camera and scene stand still, after the technique has converged: all change is flicker.
struct FlickerMoments {
    SeedMoments frames;         ///< over time: each frame is one seed
    std::vector<double> steps;  ///< sum over the frames of (x_t - x_(t-1))^2, per channel
    HostImage last;

    /// Fails on an image of another extent than the first one's, or not of three channels.
    void add(const HostImage& rgb);
};

/// For each mask: flicker, flicker_relative (if there is a reference to relate to) and flicker_correlation. The
/// variance over T frames that are correlated over a time of about 1/a frames (an exponential history of weight a)
/// is too small by about 2 (1 - a) / (a T) of itself. Where the measured correlation 1 - a makes that more than
/// a fifth, flicker has a note in place of a value. Intervals are those of jackknife_half_width(), without that error.
/// Fails below two frames.
std::vector<TemporalScore> flicker_scores(const FlickerMoments& moments, const MetricReference* reference,
                                          std::span<const Mask> masks);
