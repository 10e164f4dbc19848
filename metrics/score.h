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
    double uncorrected;  ///< with the reference's noise, by the same formula
    bool corrected;
    std::optional<double> low,
        high;                     ///< 95 % interval of `value` due to the reference's noise, where known
    std::optional<double> floor;  ///< metric(half A, half B): above the score of the reference's noise alone, as each
                                  ///< half has twice the noise variance
    size_t pixels;                ///< finite ones inside the mask
    NoiseGrowth growth = {};      ///< growth of the mean behind `value`, if it extrapolates the interval
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

/// All metrics under all masks; masks vary fastest. `counts`, if given, gets the bad pixels of the test image. `noise`,
/// if given, gets per score how the reference's noise moves its value, to first order: 0 outside the mask, empty where
/// unknown. It serves to find the noise of means of several scores.
///
/// Corrected metrics (means of weighted squares), `bias` and `energy_ratio` have intervals of the noise. All other
/// metrics are made from the mean of a map (Metric::mean_map), and their value contains the reference's noise. Their
/// interval reaches to the value without noise (metrics/extrapolation.h). cvvdp_0_5_6 has an interval of its own
/// (metrics/jod_interval.h). SSIM metrics and those of PU21 codes have none.
std::vector<Score> score(const MetricReference& reference, const HostImage& test, std::span<const Mask> masks,
                         PixelCounts* counts = nullptr, std::vector<NoisyMap>* noise = nullptr);
