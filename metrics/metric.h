#pragma once
#include "metrics/cvvdp/display.h"
#include "metrics/flip.h"
#include "metrics/noise.h"
#include "metrics/plane.h"
#include "metrics/statistics/estimates.h"
#include "metrics/tone_map.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Settings that `metric` values depend on besides the two images. Keep them with the numbers.
struct MetricSettings {
    float exposure_ev = 0.0f;                             ///< display metrics look at radiance x 2^exposure_ev, ...
    ToneMap tone_map = ToneMap::none;                     ///< ... tone-mapped, clamped to [0, 1] and sRGB-coded
    float pixels_per_degree = default_pixels_per_degree;  ///< of FLIP's observer
    ToneMap hdr_flip_tone_map = ToneMap::aces;
    /// For hdr_flip only: flip_exposure_range() of the scene's full reference image.
    std::optional<FlipExposures> flip_exposures;
    /// For metrics with is_of_display only, which look at radiance x 2^exposure_ev on a linear display, at sRGB codes
    /// on others.
    Viewing viewing{.display = display_named("standard_hdr_linear")};
};

/// Numbers of pixels with a NaN, infinite or negative channel. Each pixel counts once, for the first that applies.
struct PixelCounts {
    size_t nan = 0, infinite = 0, negative = 0;
    size_t non_finite() const { return nan + infinite; }
};
PixelCounts count_bad_pixels(const HostImage& rgb);

/// Two images made ready for measuring. A pixel with NaN or Inf in either image is black in both and outside `finite`,
/// so that no mean and no neighbour's window contains it. `reference_counts` and `test_counts` count such pixels.
struct ImagePair {
    HostImage reference, test;              ///< linear
    HostImage reference_codes, test_codes;  ///< sRGB codes in [0, 1]
    Mask finite;
    PixelCounts reference_counts, test_counts;
    MetricSettings settings;
};

/// From linear images of three channels and one extent; fails if they differ in it or are empty.
ImagePair image_pair(const HostImage& reference, const HostImage& test, const MetricSettings& settings);

/// As above, with sRGB codes that are known (from PNG files) and used unchanged.
ImagePair image_pair(const HostImage& reference, const HostImage& test, const HostImage& reference_codes,
                     const HostImage& test_codes, const MetricSettings& settings);

enum class Better { lower, higher, near_zero, near_one };

/// One measure of the difference between a test image and its reference. `layers` computes the values of all pixels
/// once; `pool` reduces them to one number per mask, NaN if no pixel is inside. Windowed metrics (ssim, flip) average
/// their map inside the mask: their windows reach beyond its border. cvvdp_0_5_6 has a number for the mask `all` alone.
struct Metric {
    std::string name;
    std::string formula;  ///< id of the exact formula: tools disagree on what a name means
    std::string unit;     ///< "1" if none
    Better better;
    std::string doc;                                 ///< formula and source
    std::vector<Plane> (*layers)(const ImagePair&);  ///< the first one is the error map
    double (*pool)(std::span<const Plane> layers, const Mask& mask);

    /// The weight of metrics that are the mean over pixels and channels of weight(r) (x - r)^2, from which noise in r
    /// can be subtracted (metrics/noise.h). nullptr for all other metrics.
    double (*squared_error_weight)(double reference) = nullptr;
    /// Id of the formula with the weight of a path-traced reference's guide instead of its noisy pixels. Empty if the
    /// weight does not depend on the reference.
    std::string guided_formula = {};

    /// A map whose mean over the mask, after `of_mean`, is the value. Tiles of the map move the value as tiles of the
    /// images do, to first order. nullptr if the metric is no such mean, or if `layers` holds the map.
    Plane (*mean_map)(std::span<const Plane> layers, const Mask& mask) = nullptr;
    double (*of_mean)(double mean) = nullptr;  ///< monotonic; nullptr: the mean itself
    /// The 95 % interval that the reference's noise leaves to a value that is no mean over pixels. `layers`: against
    /// the reference, half A and half B. nullptr: by the means above, or none.
    std::optional<Interval> (*noise_interval)(const std::array<std::span<const Plane>, 3>& layers,
                                              const ReferenceHalves& halves, const MetricSettings& settings) = nullptr;
    double greatest = INFINITY;  ///< upper bound
    bool is_of_display = false;  ///< its value depends on MetricSettings::viewing
};

/// All metrics, in the order of lists and tables.
const std::vector<Metric>& all_metrics();
std::vector<std::string> metric_names();

/// Fails on an unknown name, with the nearest known one.
const Metric& metric_named(const std::string& name);

/// One number: the metric over the finite pixels inside `mask` (all pixels if nullptr).
double measure(const Metric& metric, const ImagePair& pair, const Mask* mask = nullptr);

/// The pixels inside both masks, named as `a`.
Mask intersection(const Mask& a, const Mask& b);
Mask full_mask(glm::uvec2 extent);
