#pragma once
#include "metrics/score.h"
#include "metrics/statistics.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// A number that is made of a sequence of frames. There is no standard of such metrics, and names vary: the formula's
/// id and `doc` say what is meant.
struct TemporalMetric {
    std::string name;
    std::string formula;
    std::string unit;
    Better better;
    std::string doc;
};

/// flicker, flicker_relative, flicker_correlation, frame_difference, frame_difference_relative (this file);
/// ghost_length, settling_length (ghost.h).
const std::vector<TemporalMetric>& temporal_metrics();

/// Fails on an unknown name, with the nearest known one.
const TemporalMetric& temporal_metric_named(const std::string& name);

/// One row of results.
struct TemporalScore {
    const TemporalMetric* metric;
    std::string mask;
    double value = NAN;  ///< freed of the reference's noise if `corrected`; NaN if `note` says why there is none
    bool corrected = false;
    std::optional<double> uncorrected;  ///< with that noise: of frame differences
    std::optional<double> low, high;    ///< 95 % interval, where it can be told
    size_t pixels = 0;                  ///< finite ones inside the mask (frame differences: summed over the steps)
    size_t left_out = 0;                ///< those inside the mask that were NaN or Inf in some image (likewise)
    std::string note;                   ///< why there is no value; else empty
};

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
/// comes out too small by about 2 / (a T) of itself: take T well above 10 / a. Intervals are those of
/// jackknife_half_width(), and say nothing of that. Fails below two frames.
std::vector<TemporalScore> flicker_scores(const FlickerMoments& moments, const MetricReference* reference,
                                          std::span<const Mask> masks);

/// Whether a technique changes from frame to frame as the truth does, summed over the steps of a sequence; also over a
/// single one. It is blind to an error that stays: read it beside the error of single frames.
struct FrameDifference {
    /// The masks must have the same names in the same order at each step; pixels are those of the later frame. The
    /// references may be one and the same: their difference is then exactly 0. Fails on different extents.
    void add(const HostImage& test_before, const HostImage& test, const MetricReference& reference_before,
             const MetricReference& reference, std::span<const Mask> masks);

    /// For each mask: frame_difference and frame_difference_relative. Where all references have halves A, B, their
    /// noise is taken out: with dA = A_t - A_(t-1), dB likewise, E[(dx - dA)(dx - dB)] = (dx - dtruth)^2, as the noises
    /// of the halves are independent. Intervals are what that noise leaves, as those of score(): noise_half_width().
    std::vector<TemporalScore> scores() const;

    struct Sums {
        std::string mask;
        std::array<double, 2> corrected{}, uncorrected{};  ///< squared, and relative
        std::array<Plane, 2> swapped;                      ///< see noise_half_width(); 0 outside of the mask
        size_t pixels = 0, left_out = 0;
    };
    std::vector<Sums> sums;  ///< of each mask
    bool has_halves = true;
};
