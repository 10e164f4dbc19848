#pragma once
#include "metrics/extrapolation.h"
#include "metrics/metric.h"
#include "metrics/noise.h"

#include <optional>
#include <span>
#include <vector>

/// One row of results.
struct Score {
    const Metric* metric;
    std::string formula;  ///< id: the metric's, or its guided one
    std::string mask;
    double value;        ///< noise-corrected if `corrected`; NaN if no pixel is inside the mask
    double uncorrected;  ///< with the reference's noise in it, by the same formula
    bool corrected;
    std::optional<double> low,
        high;                     ///< 95 % interval of `value` due to the reference's noise, where known
    std::optional<double> floor;  ///< metric(half A, half B): overestimates the score of the reference's noise, as each
                                  ///< half has twice its variance
    size_t pixels;                ///< finite ones inside the mask
    NoiseGrowth growth = {};      ///< of the mean that `value` is, where the interval is extrapolated from it
};

/// A reference and all that does not depend on the test image, made once and used for many tests.
struct MetricReference {
    HostImage image;
    std::optional<ReferenceHalves> halves;
    std::vector<const Metric*> metrics;
    MetricSettings settings;
    Mask finite;                                   ///< pixels finite in the image and in both halves
    std::vector<std::vector<Plane>> floor_layers;  ///< per metric, of (A, B)

    /// The weight of relative errors: the guide where there is one, else the image.
    const HostImage& weighing_image() const { return halves ? halves->guide : image; }
};

MetricReference metric_reference(HostImage image, std::optional<ReferenceHalves> halves,
                                 const std::vector<std::string>& metric_names, const MetricSettings& settings);

/// All metrics under all masks: masks vary fastest. `counts`, if given, gets the bad pixels of the test image. `noise`,
/// if given, gets for each score how the reference's noise moves its value, to first order, for the noise of means
/// of several scores: 0 outside of the mask; empty where unknown.
///
/// Intervals: of metrics that are corrected (means of weighted squares), `bias` and `energy_ratio`, the ratio of a
/// fixed mean to that of the reference. All others are means of a map, or made of one (Metric::mean_map), and carry the
/// reference's noise in their value; their intervals reach to where it would lie without (metrics/extrapolation.h). The
/// forms of SSIM have none.
std::vector<Score> score(const MetricReference& reference, const HostImage& test, std::span<const Mask> masks,
                         PixelCounts* counts = nullptr, std::vector<NoisyMap>* noise = nullptr);
