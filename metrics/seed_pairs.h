#pragma once
#include "metrics/statistics.h"

/// What each two of N seeds tell of an image by themselves, as means over channels and pixels. The pair of the seeds
/// i < j, counted from 0, stands at j (j - 1) / 2 + i.
struct SeedPairs {
    std::vector<double> variance;  ///< (x - y)^2 / 2
    /// ((x - A)(y - B) + (y - A)(x - B)) / 2 with the halves A, B of the reference: all four noises are independent, so
    /// its expectation is bias^2, without what noise adds to a square. Around 0 where there is no bias.
    std::vector<double> bias_squared;
};

/// Of the pixels inside of the mask, which must be finite in all images. A reference without noise is its own half
/// twice.
SeedPairs seed_pairs(std::span<const HostImage> seeds, const HostImage& half_a, const HostImage& half_b,
                     const Mask& inside);

/// The mean over all pairs of the chosen seeds: unbiased, and with less scatter than that of disjoint pairs (a
/// U-statistic: Hoeffding 1948, "A Class of Statistics with Asymptotically Normal Distribution"). `without` is empty
/// for two seeds. Fails below that.
///
/// Coverage of jackknifed_ratio() of such in 1500 simulated studies of 4, 8 and 16 seeds: 95 to 97 % for ratios of
/// variances, and of squared biases as large as those; 98 to 100 %, with wide intervals, where squared biases hardly
/// show above the noise; 90 to 94 % for ratios of variances where the seeds' deviations are log-normal of 0.5 to 1.
Jackknifed jackknifed_pairs(std::span<const double> of_pairs, std::span<const size_t> chosen);
