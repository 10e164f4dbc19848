#pragma once
#include "metrics/score.h"

#include <span>
#include <vector>

/// A mean with its 95 % confidence interval.
struct Estimate {
    double value, low, high;
};

/// The mean of independent, nearly normal values by Student's t: mean +- t(0.975, N - 1) s / sqrt(N). Fails for fewer
/// than two. Squared errors are skewed: take 8 values or more.
Estimate mean_estimate(std::span<const double> values);

struct RatioEstimate {
    Estimate ratio;
    double p_value;  ///< two-sided, of "the ratio is 1"
};

/// The geometric mean of a_i / b_i, where a_i and b_i share seed, camera and scene: the mean of ln(a_i / b_i), by
/// Student's t. Fails on unequal or fewer than two values, and on values that are not above 0.
RatioEstimate paired_ratio(std::span<const double> a, std::span<const double> b);

/// p-values adjusted so that all can be judged at one level together, in the order given (Holm 1979, "A Simple
/// Sequentially Rejective Multiple Test Procedure").
std::vector<double> holm_adjusted(std::span<const double> p_values);

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

/// mse = bias_squared + variance, of one seed, over pixels and channels.
struct ErrorSplit {
    double mse, bias_squared, variance;
};

/// What of the error more samples or filters would remove (variance), and what is wrong with the technique (bias). The
/// mean of N seeds keeps V / N of the variance, and the reference its own: both are subtracted, (m - A)(m - B) - V / N,
/// without which the bias of a noisy technique comes out several times too large. Single pixels of it, and the mean
/// where there is no bias, may be negative: that is noise around 0. Without halves the reference counts as exact. Fails
/// below two seeds.
ErrorSplit split_error(const SeedMoments& seeds, const HostImage& reference,
                       const std::optional<ReferenceHalves>& halves, const Mask& mask);
