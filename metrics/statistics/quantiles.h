#pragma once
#include <cstddef>

/// Distribution functions and their inverses, to about 1e-12. Probabilities in (0, 1), degrees of freedom above 0.
double normal_quantile(double probability);
double student_t_cdf(double t, double degrees);
double student_t_quantile(double probability, double degrees);
double chi_squared_quantile(double probability, double degrees);

/// Probability that the range of `count` (two or more) standard normal values exceeds `range` times a standard
/// deviation that is known with so many degrees of freedom: the tail of the studentised range (Tukey), to 1e-6 by
/// quadrature.
double studentised_range_tail(double range, size_t count, double degrees);

/// Distribution of (normal + noncentrality) / sqrt(chi squared / degrees): Student's t with a mean of `noncentrality`
/// standard errors.
double noncentral_t_cdf(double t, double degrees, double noncentrality);
