#pragma once
#include "metrics/statistics/estimates.h"

/// The factor f of median_interval().
double sign_variance_factor(std::span<const double> in_order_of_time);

/// The median of values in order of time, and its 95 % interval from order statistics: the ranks n / 2 -+ 1.96 sqrt(f
/// n) / 2 of a binomial distribution with p = 1/2. Disturbances last for several rounds, so the variance is f times
/// that of independent signs. f = 1 + 2 sum rho_k over the autocorrelations of the signs before the first that is not
/// above 0 (the initial positive sequence of Geyer 1992, "Practical Markov Chain Monte Carlo"), at least 2, as 15
/// rounds estimate it poorly. The interval is the range if there are too few values. metrics/coverage.md has the
/// measured coverage. Fails with Error if there is no value.
Estimate median_interval(std::span<const double> in_order_of_time);
