#pragma once
#include "experiments/results/tradeoff/tradeoff.h"

#include <map>
#include <span>

/// A point of one shot as `ssrlab tradeoff` judged it, with the measurements of its error and cost.
struct MeasuredPoint {
    FrontRow row;
    /// seed and error; one entry if the point does not depend on seeds
    std::vector<std::pair<unsigned, double>> seeds;
    /// ms by seed and frame; empty for costs that are not timed
    std::map<std::pair<unsigned, unsigned>, double> rounds;
    double disturbed_share = 0;  ///< of the timed frames

    PointName name() const { return {row.technique, row.point}; }
    double error() const { return *row.error; }
    double cost() const { return *row.cost; }
    bool is_ranked() const { return row.verdict != "uses scene data" && row.verdict != "not ranked"; }
    /// Whether error and cost can be judged: both are above 0, and the error has an interval.
    bool is_judged() const;
};

/// Random draws of the true errors and costs of points of one shot: by point, then by draw.
///
/// A mean error over k seeds is drawn from Student's t with k - 1 degrees of freedom around the measured mean. A median
/// cost is drawn from the binomial distribution of its rank among the rounds, widened by sign_variance_factor(). Points
/// share the normal deviate of each seed and of each round, so effects that several points have in common stay common.
/// The rest of an error's interval, the reference's noise, is one deviate for each technique. Errors move by a factor
/// exp(d / error): never to 0 or below, and further up than down.
struct Draws {
    std::vector<std::vector<double>> errors, costs;
};

/// standard deviations from the mean to an end of a normal's 95 % interval
inline constexpr double normal_95 = 1.959964;

/// Draws for judged points; equal seeds give equal draws.
Draws draws_of(std::span<const MeasuredPoint* const> points, unsigned seed, size_t count = 2000);

/// The quantile `share` of ascending values (at least one), interpolated between neighbours: 0.5 is the median.
double quantile_of(std::span<const double> ascending, double share);
