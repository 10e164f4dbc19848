#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"

#include <optional>

// Removes the noise of a path-traced reference R = (A + B) / 2 from squared errors without bias:
//     E[(x - A)(x - B)] = (x - truth)^2,     (x - A)(x - B) = (x - R)^2 - (A - B)^2 / 4.
// Single pixels may be negative and must not be clamped before averaging. metrics/README.md explains the statistics.

/// Two independent halves of equal sample counts, whose mean is the reference. A noise-free reference has none. All
/// images: linear, three channels, of one extent.
struct ReferenceHalves {
    HostImage a, b;
    HostImage variance;  ///< of the mean, per channel, estimated from batches within the halves
    HostImage guide;     ///< weights relative errors; near the truth and independent of the noise of both halves
    double samples = 0;  ///< of each pixel, at least
};

/// Per pixel, the mean over channels of weight(w) (x - A)(x - B), where w is the pixel of `weighing`.
Plane cross_error(const HostImage& test, const HostImage& half_a, const HostImage& half_b, const HostImage& weighing,
                  double (*weight)(double));

/// Per-pixel terms of a sum, free of the reference's noise on average, and how this noise moves them.
struct NoisyMap {
    Plane error;  ///< the terms; empty if they keep the noise
    /// Per pixel, half the term's change when half A alone replaces half B as the reference. (A, B) and (B, A) are
    /// equally likely, so its mean square is the term's variance. For squared errors both are 2 s^2 (x - truth)^2 + s^4
    /// if the noise of a half is Gaussian with variance s^2.
    Plane swapped;
    Plane variance;      ///< the same variance from batches; only its ratios between pixels matter
    double samples = 0;  ///< of each pixel, at least
    /// The terms are differences of two outputs that share samples or random numbers. Few samples in few pixels may
    /// decide such a difference, and `variance` may be too large, most of all in other pixels.
    bool is_difference = false;

    bool is_empty() const { return swapped.values.empty(); }
};
/// A map of zeros with an empty `error`.
NoisyMap noisy_map(glm::uvec2 extent, double samples);
/// Adds the noise of the terms inside the mask to `sum`, which may be empty, but not their `error`.
void add_noise(NoisyMap& sum, const NoisyMap& terms, const Mask& mask);

/// The variance of the sum over channels of weight (d - a)(d - b), where a and b are the noises of the halves. Channels
/// share paths, so their noises are treated as equal.
struct SquaredErrorVariance {
    double linear = 0, product = 0;

    /// `variance` is that of (a + b) / 2.
    void add(double weight, double error, double variance);
    double value() const { return 2 * linear * linear + product * product; }
};

/// cross_error() against the reference's own halves.
NoisyMap squared_error(const HostImage& test, const ReferenceHalves& halves, const HostImage& weighing,
                       double (*weight)(double));

/// The noise of x - R per pixel, mean over channels; `error` is empty.
NoisyMap mean_noise(const ReferenceHalves& halves);

/// Half the width of the 95 % interval of the sum of a per-pixel quantity over the mask due to the reference's noise: t
/// sqrt(sum of swapped^2), as pixels are independent. Student's t has nu = (sum of v)^2 / (sum of v^2) degrees of
/// freedom, with the batches' variances v (Satterthwaite 1946, "An Approximate Distribution of Estimates of Variance
/// Components"). nu is the number of pixels that carry the noise. For differences it is the smaller of this and the
/// same formula with v = swapped^2.
///
/// None if one pixel carries nearly all noise: nu below least_noise_pixels, for differences least_difference_pixels.
/// None below least_noise_samples under the mask, which miss rare paths. 0 without noise. No limit tests how heavy the
/// noise's tail looks: lucky references look best, and their intervals cover less. metrics/coverage.md has the measured
/// coverage.
std::optional<double> noise_half_width(const NoisyMap& terms, const Mask& mask);

inline constexpr double least_noise_pixels = 1.25, least_difference_pixels = 8;  ///< nu
inline constexpr double least_noise_samples = 4096;  ///< summed over all noisy pixels under the mask
