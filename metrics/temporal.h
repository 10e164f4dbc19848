#pragma once
#include "metrics/score.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

/// A metric of a sequence of frames. Such metrics have no standard and their names vary: `formula` and `doc` define
/// them.
struct TemporalMetric {
    std::string name;
    std::string formula;
    std::string unit;
    Better better;
    std::string doc;
    std::string guided_formula = {};  ///< as Metric::guided_formula
    double greatest = INFINITY;       ///< upper bound
    bool is_of_truth = false;         ///< compares frames with a path-traced truth, whose noise its interval holds;
                                      ///< else the interval is that of the choice of pixels
};

/// flicker, flicker_relative, flicker_correlation (flicker.h); frame_difference, frame_difference_relative
/// (frame_difference.h); ghost_share (ghost_share.h); ghost_length, settling_length (ghost.h); cvvdp_0_5_6_video
/// (video_jod.h).
const std::vector<TemporalMetric>& temporal_metrics();

/// Fails on an unknown name, with the nearest known one.
const TemporalMetric& temporal_metric_named(const std::string& name);

/// nullptr if no metric of sequences has this name.
const TemporalMetric* find_temporal_metric(const std::string& name);

/// One row of results.
struct TemporalScore {
    const TemporalMetric* metric;
    std::string formula;  ///< id: the metric's, or its guided one
    std::string mask;
    double value = NAN;  ///< without the reference's noise if `corrected`; NaN if `note` says why there is none
    bool corrected = false;
    std::optional<double> uncorrected;  ///< with the reference's noise; frame differences only
    std::optional<double> low, high;    ///< 95 % interval, where known
    size_t pixels = 0;                  ///< finite pixels inside the mask (frame differences: summed over the steps)
    size_t left_out = 0;                ///< pixels inside the mask that are NaN or Inf in some image (likewise)
    std::string note;                   ///< the reason for a missing value; else empty
};

inline constexpr const char* no_pixel = "no finite pixel is inside the mask";

/// A row without a value. Its note is `no_pixel` if no finite pixel is inside the mask. `finite`: the pixels that are
/// finite in all images of the sequence.
TemporalScore empty_score(const std::string& metric, const Mask& mask, const Mask& finite);

/// Removes the pixels from `mask` where the image is NaN or Inf. Fails if the image has another extent or not three
/// channels.
void keep_finite(Mask& mask, const HostImage& rgb);

/// 1 / (r^2 + 0.01), the weight of relmse.
double relative_weight(double reference);

/// The metric's own formula, or its guided one where the reference has a guide.
std::string formula_of(const TemporalMetric& metric, bool has_guide);
