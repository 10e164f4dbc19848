#pragma once
#include "metrics/plane.h"

#include <optional>
#include <span>

// Intervals of metrics that are no means of squares (FLIP, SSIM, absolute differences), extrapolated to a reference
// without noise: metrics/README.md, "Intervals of FLIP, SSIM and absolute differences".

/// The reference R moved by so many times (A - B) / 2 has 4 times the variance of its noise.
inline constexpr double extrapolation_step = 1.7320508075688772;  // sqrt(3)

/// Range of a mean without noise: of two laws of its growth, and the mean itself.
struct Extrapolated {
    double low = 0, high = 0;
};

/// `at_one`, `at_two`, `at_four`: the mean against references whose noise has so many times the variance v of the
/// reference's own. Laws: m + b v^p with 0.25 <= p <= 1, and a + b / (c + v).
Extrapolated without_noise(double at_one, double at_two, double at_four);

struct MapInterval {
    std::optional<double> low, high;
};

/// The 95 % interval of the mean of `map` over the mask due to the reference's noise. `halves` and `moved_on`: the maps
/// against A and B, and against both moved on. The range of the mean without noise, widened by
///
/// - half its change between half A and half B, summed over tiles, whose squares add up like those of pixels in
///   noise_half_width(): windows make neighbours share noise, but are smaller than a tile (metrics/tiles.h). Student's
///   t has 3 (sum of s^2)^2 / (sum of s^4) degrees of freedom, the number of tiles where all are alike;
/// - on the extrapolated side, the uncertainty of the extrapolation over tiles (jackknife_half_width()).
///
/// None below two tiles. metrics/README.md has the measured coverage.
MapInterval extrapolated_interval(const Plane& map, std::span<const Plane> halves, std::span<const Plane> moved_on,
                                  const Mask& mask);
