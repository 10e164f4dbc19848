#pragma once
#include "metrics/seed_pairs.h"
#include "metrics/statistics/estimates.h"
#include "metrics/temporal.h"

#include <span>
#include <vector>

/// Frames of a shot where camera and scene stand still, after the technique has converged: all change is flicker.
struct FlickerMoments {
    SeedMoments frames;         ///< moments over time: each frame counts as one seed
    std::vector<double> steps;  ///< sum over the frames of (x_t - x_(t-1))^2, per channel
    HostImage last;

    /// Fails on an image of another extent than the first one's, or not of three channels.
    void add(const HostImage& rgb);
};

/// For each mask: flicker, flicker_relative (only with a reference) and flicker_correlation. An exponential history of
/// weight a correlates frames over about 1/a frames. The variance over T frames is then too small by a share of about 2
/// (1 - a) / (a T). If the measured correlation 1 - a makes this share exceed a fifth, flicker has a note instead of a
/// value. Intervals are those of jackknife_half_width(), without this error. Fails below two frames.
std::vector<TemporalScore> flicker_scores(const FlickerMoments& moments, const MetricReference* reference,
                                          std::span<const Mask> masks);
