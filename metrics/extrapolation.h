#pragma once
#include "metrics/plane.h"

#include <optional>
#include <span>

// Metrics that are no means of squares (FLIP, SSIM, absolute differences) cannot be freed from the reference's noise
// pixel by pixel. What the noise adds to their mean is extrapolated: measured against the reference, whose noise has
// the variance v, against its halves (2 v), and against both moved on (4 v), towards a reference without noise (SIMEX:
// Cook, Stefanski 1994, "Simulation-Extrapolation Estimation in Parametric Measurement Error Models").

/// The reference R moved on by so many times (A - B) / 2 has 4 times the variance of its noise.
inline constexpr double extrapolation_step = 1.7320508075688772;  // sqrt(3)

/// Where a mean would lie without noise: what two laws of its growth say, and the mean as it is.
struct Extrapolated {
    double low = 0, high = 0;
};

/// `at_one`, `at_two`, `at_four`: the mean against references whose noise has so many times the variance of the
/// reference's own. Laws: m + b v^p with 0.25 <= p <= 1, since what noise adds is proportional to the variance where a
/// pixel's error is large, and to the deviation or less where there is none; and a + b / (c + v), for metrics that
/// noise saturates, as it does SSIM in flat regions.
Extrapolated without_noise(double at_one, double at_two, double at_four);

struct MapInterval {
    std::optional<double> low, high;
};

/// The 95 % interval that the reference's noise leaves to the mean of `map` over the mask. `halves` and `moved_on` are
/// the maps against A and B, and against both moved on. Where the mean would lie without noise, widened by
///
/// - half its change when half A is believed in place of half B, summed over tiles, whose squares add up as those of
///   pixels do in noise_half_width(): windows make neighbours share noise, but reach less far than a tile
///   (metrics/tiles.h). Student's t has 3 (sum of s^2)^2 / (sum of s^4) degrees of freedom, the number of tiles where
///   all are alike;
/// - on the side that is extrapolated to, by how well the tiles agree on how far (jackknife_half_width()).
///
/// None below two tiles. metrics/README.md has the measured coverage.
MapInterval extrapolated_interval(const Plane& map, std::span<const Plane> halves, std::span<const Plane> moved_on,
                                  const Mask& mask);
