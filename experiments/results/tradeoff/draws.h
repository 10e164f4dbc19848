#pragma once
#include "experiments/results/tradeoff/tradeoff.h"

#include <map>
#include <span>

/// A point of one shot as `ssrlab tradeoff` judged it, with all that its error and its cost were measured by.
struct MeasuredPoint {
    FrontRow row;
    std::vector<std::pair<unsigned, double>> seeds;  ///< with its error; one of a point that does not depend on it
    std::map<std::pair<unsigned, unsigned>, double> rounds;  ///< seed and frame to ms; none of costs that are not timed
    double disturbed_share = 0;                              ///< of the timed frames

    PointName name() const { return {row.technique, row.point}; }
    double error() const { return *row.error; }
    double cost() const { return *row.cost; }
    bool is_ranked() const { return row.verdict != "uses scene data" && row.verdict != "not ranked"; }
    /// By error and cost: both are above 0, and the error has an interval.
    bool is_judged() const;
};

/// Errors and costs as they might truly be, of points of one shot: by point, then by draw.
///
/// A mean error over k seeds is drawn from Student's t with k - 1 degrees of freedom about the measured one, and a
/// median cost from the binomial distribution of its rank among the rounds, widened by sign_variance_factor(). Points
/// share the normal deviate of each seed and of each round, so that what seeds and slow frames do to several points at
/// once stays common. What the interval of an error holds beyond its seeds, the reference's noise, is one deviate for
/// each technique. Errors move by a factor exp(d / error): never to 0 or below, and further up than down.
struct Draws {
    std::vector<std::vector<double>> errors, costs;
};

inline constexpr double normal_95 = 1.959964;  ///< standard deviations from the middle to an end of a normal's 95 %

/// The same draws whenever `seed` is the same. Of judged points.
Draws draws_of(std::span<const MeasuredPoint* const> points, unsigned seed, size_t count = 2000);

/// Of values in ascending order, one or more, between neighbours: 0.5 is the median.
double quantile_of(std::span<const double> ascending, double share);
