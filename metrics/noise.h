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
    HostImage guide;     ///< weights relative errors: near the truth, and independent of the noise of both
    double samples = 0;  ///< of each pixel, at least
};

/// mean over channels of weight(w) (x - A)(x - B) of each pixel, w the pixel of `weighing`.
Plane cross_error(const HostImage& test, const HostImage& half_a, const HostImage& half_b, const HostImage& weighing,
                  double (*weight)(double));

/// A term of a sum over pixels, free of the reference's noise on average, and how that noise moves it: half the change
/// when the reference's halves change places, and the variance of that from batches.
struct NoisyMap {
    Plane error;  ///< empty of terms that keep the noise
    /// Per pixel, half the change when half A alone is the reference in place of B: (A, B) and (B, A) are equally
    /// likely, and its square is on average the variance of the pixel's own term. For squared errors both are
    /// 2 s^2 (x - truth)^2 + s^4 if the noise is Gaussian with s^2 that of a half.
    Plane swapped;
    Plane variance;      ///< that variance again, from the batches: only its shares among the pixels matter
    double samples = 0;  ///< of each pixel, at least
    /// Of the difference of two outputs that share samples or random numbers. It may depend on few samples in few
    /// pixels, and `variance` may be an overestimate that is largest elsewhere.
    bool is_difference = false;

    bool is_empty() const { return swapped.values.empty(); }
};
/// With planes of zeros, but for `error`, which is empty.
NoisyMap noisy_map(glm::uvec2 extent, double samples);
/// Adds how the noise moves the terms inside of the mask to `sum`, which may be empty; not their `error`.
void add_noise(NoisyMap& sum, const NoisyMap& terms, const Mask& mask);

/// The variance of sum over channels of weight (d - a)(d - b), where a and b are the noises of the halves, treated as
/// equal in all channels, which share paths.
struct SquaredErrorVariance {
    double linear = 0, product = 0;

    /// `variance` is that of (a + b) / 2.
    void add(double weight, double error, double variance);
    double value() const { return 2 * linear * linear + product * product; }
};

/// cross_error() against the reference's own halves.
NoisyMap squared_error(const HostImage& test, const ReferenceHalves& halves, const HostImage& weighing,
                       double (*weight)(double));

/// Of a pixel's x - R, mean over channels; without `error`.
NoisyMap mean_noise(const ReferenceHalves& halves);

/// Half the width of the 95 % interval of the sum of a per-pixel quantity over the mask due to the reference's noise:
/// t sqrt(sum of swapped^2), as pixels are independent. Student's t has nu = (sum of v)^2 / (sum of v^2) degrees of
/// freedom, the number of pixels that carry the noise, with the batches' variances v (Satterthwaite 1946, "An
/// Approximate Distribution of Estimates of Variance Components"); of differences the smaller of this and the same of
/// swapped^2.
///
/// None where one pixel carries nearly all noise (nu below 1.25; of differences below 8), and below
/// least_noise_samples under the mask, which miss what is rare; 0 without noise. Neither limit is one of how heavy the
/// noise's tail looks: references that are lucky look best, and intervals of those alone cover less. metrics/README.md
/// has the measured coverage.
std::optional<double> noise_half_width(const NoisyMap& terms, const Mask& mask);

inline constexpr double least_noise_pixels = 1.25, least_difference_pixels = 8;  ///< nu
inline constexpr double least_noise_samples = 4096;                              ///< of all noisy pixels under the mask
