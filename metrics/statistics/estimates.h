#pragma once
#include <optional>
#include <span>
#include <vector>

/// A 95 % confidence interval.
struct Interval {
    double low = 0, high = 0;
};

/// A mean or median with its 95 % confidence interval.
struct Estimate {
    double value = 0, low = 0, high = 0;
};

/// The mean of independent, nearly normal values by Student's t: mean +- t(0.975, N - 1) s / sqrt(N). Fails for fewer
/// than two. Squared errors are skewed: take 8 values or more.
Estimate mean_estimate(std::span<const double> values);

/// An estimate from N seeds, and the same estimate without each one of them in turn.
struct Jackknifed {
    double value;
    std::vector<double> without;
};

/// The mean; `without` is empty for a single value.
Jackknifed jackknifed_mean(std::span<const double> values);

struct RatioEstimate {
    double value;
    std::optional<double> low, high;  ///< 95 % interval
    std::optional<double> p_value;    ///< two-sided, for "the ratio is 1"; below 0.05 where the interval excludes 1
    // Of ln(value), where there is an interval:
    double standard_error = 0, degrees = 1;   ///< of Student's t
    double excess_of_a = 0, excess_of_b = 0;  ///< extensions of the two ends, in logarithms

    /// The interval with `error` in (0, 1) as the probability of error; it excludes 1 where p_value is below `error`.
    /// Call it only if `low` and `high` are known.
    std::pair<double, double> interval(double error) const;

    /// Two-sided p-value of "the ratio is at least 1 and at most `most`", which is 1 or more; equals p_value for 1.
    /// Call it only if `low` and `high` are known.
    double p_outside(double most) const;

    /// The p-value of "the ratio is not between 1 / (1 + margin) and 1 + margin": the larger p of two one-sided tests
    /// (Schuirmann 1987, "A Comparison of the Two One-Sided Tests Procedure and the Power Approach"). Call it only if
    /// `low` and `high` are known; `margin` is above 0.
    double p_beyond(double margin) const;
};

/// The larger p of two one-sided tests of "`value` is not between -limit and limit", Student's t with `degrees`.
/// `down`, `up`: how much further a bias may reach to either side.
double p_beyond_limits(double value, double limit, double standard_error, double degrees, double down = 0,
                       double up = 0);

/// Uncertainty of ln(a / b) beside the scatter of the seeds, and independent of it: a variance with its degrees of
/// freedom. `excess_of_a`, `excess_of_b`: shares by which a and b may be too large, below 1.
struct SharedScatter {
    double variance = 0, degrees = 1;
    double excess_of_a = 0, excess_of_b = 0;
};

/// The variance of a sum of independent terms of mean 0, each known by its own size alone, and its degrees of freedom:
/// 3 (sum of s^2)^2 / (sum of s^4), the number of terms if all are alike (Satterthwaite 1946), and at most `terms`.
SharedScatter scatter_of_terms(std::span<const double> changes, double terms);

/// a / b, both estimated from the same N seeds, so that common random numbers cancel. The interval is that of a
/// jackknife of ln(a / b) with Student's t of N - 1 degrees (Tukey 1958, "Bias and Confidence in Not-Quite Large
/// Samples"; Miller 1974, "The Jackknife - A Review"). There is none for a single seed, if an estimate without one seed
/// is not above 0, or if the interval is unbounded. The variance of `shared` is added, with Satterthwaite's degrees of
/// freedom (1946, "An Approximate Distribution of Estimates of Variance Components"). Two single values, whose
/// `without` are empty, have the interval of `shared` alone, if any. An excess of a or b extends the interval on one
/// side, and p tests the difference that no excess explains. Fails if a or b is not above 0, or if they have unequal
/// numbers of seeds. metrics/coverage.md has the measured coverage.
RatioEstimate jackknifed_ratio(const Jackknifed& a, const Jackknifed& b, const SharedScatter& shared = {});

/// p-values adjusted for their number, in the order given (Holm 1979, "A Simple Sequentially Rejective Multiple Test
/// Procedure"). `others`: number of further members of the family, which stay undecided.
std::vector<double> holm_adjusted(std::span<const double> p_values, size_t others = 0);
