#pragma once
#include "metrics/metric.h"

#include <optional>
#include <span>
#include <vector>

/// What a path-traced reference of limited samples knows of itself: two independent halves of equal sample counts,
/// whose mean is the reference. A noise-free reference has none.
struct ReferenceHalves {
    HostImage a, b;  ///< linear, three channels
};

/// One row of results.
struct Score {
    const Metric* metric;
    std::string mask;
    double value;        ///< noise-corrected if `corrected`; NaN if no pixel is inside the mask
    double uncorrected;  ///< what `measure` says
    bool corrected;
    std::optional<double> low,
        high;                     ///< 95 % interval of `value` that the reference's noise leaves, where it can be told
    std::optional<double> floor;  ///< metric(half A, half B): over-estimates what the reference's noise scores, as each
                                  ///< half has twice its variance
    size_t pixels;                ///< finite ones inside the mask
};

/// A reference and all that does not depend on the test image, to be made once and used for many tests.
struct MetricReference {
    HostImage image;
    std::optional<ReferenceHalves> halves;
    std::vector<const Metric*> metrics;
    MetricSettings settings;
    Mask finite;                                   ///< pixels finite in the image and in both halves
    std::vector<std::vector<Plane>> floor_layers;  ///< per metric, of (A, B)
    HostImage smooth;  ///< the image freed of noise as well as its halves allow: weights of relative errors
};

MetricReference metric_reference(HostImage image, std::optional<ReferenceHalves> halves,
                                 const std::vector<std::string>& metric_names, const MetricSettings& settings);

/// All metrics under all masks: masks vary fastest. `counts`, if given, gets the bad pixels of the test image.
std::vector<Score> score(const MetricReference& reference, const HostImage& test, std::span<const Mask> masks,
                         PixelCounts* counts = nullptr);
