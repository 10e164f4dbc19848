#pragma once

/// Distribution functions and their inverses, to about 1e-12. Probabilities in (0, 1), degrees of freedom above 0.
double normal_quantile(double probability);
double student_t_cdf(double t, double degrees);
double student_t_quantile(double probability, double degrees);
double chi_squared_quantile(double probability, double degrees);
