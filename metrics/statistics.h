#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"

#include <optional>
#include <span>
#include <vector>

/// A mean with its 95 % confidence interval.
struct Estimate {
    double value, low, high;
};

/// The mean of independent, nearly normal values by Student's t: mean +- t(0.975, N - 1) s / sqrt(N). Fails for fewer
/// than two. Squared errors are skewed: take 8 values or more.
Estimate mean_estimate(std::span<const double> values);

/// An estimate from N seeds, and what the same rule estimates without each one of them in turn.
struct Jackknifed {
    double value;
    std::vector<double> without;
};

/// The mean; `without` is empty for a single value.
Jackknifed jackknifed_mean(std::span<const double> values);

struct RatioEstimate {
    double value;
    std::optional<double> low, high;  ///< 95 % interval
    std::optional<double> p_value;    ///< two-sided, of "the ratio is 1": below 0.05 where the interval leaves out 1
    // Of ln(value), where there is an interval:
    double standard_error = 0, degrees = 1;   ///< of Student's t
    double excess_of_a = 0, excess_of_b = 0;  ///< by which either end reaches further, in logarithms

    /// The interval of another probability of error than 0.05, in (0, 1): it leaves out 1 where p_value is below
    /// `error`. Only where there is one at 0.05.
    std::pair<double, double> interval(double error) const;
};

/// What is uncertain of ln(a / b) beside the scatter of the seeds, and independent of it: its variance, and the degrees
/// of freedom that the variance is known with; and by which shares of themselves a and b may be too large, below 1.
struct SharedScatter {
    double variance = 0, degrees = 1;
    double excess_of_a = 0, excess_of_b = 0;
};

/// a / b, both estimated from the same N seeds: seed i shares random numbers, camera and scene, so what they have in
/// common cancels. The interval is the jackknife's of ln(a / b) with Student's t of N - 1 degrees (Tukey 1958, "Bias
/// and Confidence in Not-Quite Large Samples"; Miller 1974, "The Jackknife - A Review"). Without one for a single seed,
/// and where an estimate without one of the seeds is not above 0 or so near to it that the interval has no end among
/// finite numbers. `shared` joins it: variances add up, with Welch's and Satterthwaite's degrees of freedom
/// (Satterthwaite 1946, "An Approximate Distribution of Estimates of Variance Components"). Two single values, whose
/// `without` are empty, have an interval of what is shared alone, if anything is. What a or b may have in excess moves
/// the end of the interval on its side, and p is that of a ratio that such an excess would explain as far as it can.
/// Fails if a or b is not above 0, or if they hold unequal numbers of seeds.
///
/// Coverage of ratios of means in 40000 simulated studies of 4, 8, 16 seeds: 94.9, 95.1, 95.1 % for log-normal values
/// of deviation 0.05 and correlation 0.9; 93.3, 93.1, 93.7 % for deviation 1 without correlation; 90.5, 89.7, 90.1 %
/// where only one of a and b has deviation 1, as a mean of few skewed values mostly misses its tail. Bootstraps of
/// percentiles cover 78 to 80 % at 4 seeds, Fieller's interval (1954) of heavy tails is mostly unbounded there.
RatioEstimate jackknifed_ratio(const Jackknifed& a, const Jackknifed& b, const SharedScatter& shared = {});

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
