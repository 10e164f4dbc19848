#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"
#include "metrics/statistics/estimates.h"

/// Estimates from each pair of N seeds, as means over channels and pixels. The pair of seeds i < j, counted from 0, has
/// index j (j - 1) / 2 + i.
struct SeedPairs {
    std::vector<double> variance;  ///< (x - y)^2 / 2
    /// ((x - A)(y - B) + (y - A)(x - B)) / 2 with the halves A, B of the reference: all four noises are independent, so
    /// its expectation is bias^2, free of noise. Around 0 where there is no bias.
    std::vector<double> bias_squared;
};

/// Uses the pixels inside the mask, which must be finite in all images. For a reference without noise, both halves are
/// the reference.
SeedPairs seed_pairs(std::span<const HostImage> seeds, const HostImage& half_a, const HostImage& half_b,
                     const Mask& inside);

/// The mean over all pairs of the chosen seeds: unbiased, and with less scatter than the mean over disjoint pairs (a
/// U-statistic: Hoeffding 1948, "A Class of Statistics with Asymptotically Normal Distribution"). `without` is empty
/// for two seeds. Fails below two seeds.
///
/// metrics/coverage.md has the measured coverage of jackknifed_ratio() of such means.
Jackknifed jackknifed_pairs(std::span<const double> of_pairs, std::span<const size_t> chosen);

/// Mean and variance of each channel of each pixel over independent seeds, one image at a time (Welford 1962).
struct SeedMoments {
    glm::uvec2 extent{0, 0};
    unsigned count = 0;
    std::vector<double> mean, squares;  ///< sums of squared distances from the mean, per channel
    Mask finite;                        ///< pixels that were finite in every image

    /// Fails on an image of another extent than the first one's.
    void add(const HostImage& rgb);
    double variance(size_t value) const { return squares[value] / (count - 1); }
};
