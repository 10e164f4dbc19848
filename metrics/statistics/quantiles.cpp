#include "metrics/statistics/quantiles.h"

#include "core/error.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace {

void check_probability(double probability) {
    if (!(probability > 0 && probability < 1)) fail("a quantile needs a probability within (0, 1), not ", probability);
}

boost::math::students_t student_t(double degrees) {
    if (!(degrees > 0)) fail("degrees of freedom must be above 0, not ", degrees);
    return boost::math::students_t(degrees);
}

/// Probability that the range of `count` standard normal values exceeds `range`: the least of them is at z, and not all
/// others lie within `range` above it.
double normal_range_tail(double range, double count) {
    const auto cdf = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
    const auto at = [&](double z) {
        const double density = std::exp(-0.5 * z * z) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
        const double above = cdf(-z);
        return count * density * (std::pow(above, count - 1) - std::pow(cdf(z + range) - cdf(z), count - 1));
    };
    return boost::math::quadrature::gauss<double, 60>::integrate(at, -8.0, 8.0);
}

}  // namespace

double normal_quantile(double probability) {
    check_probability(probability);
    return boost::math::quantile(boost::math::normal(), probability);
}

double student_t_cdf(double t, double degrees) { return boost::math::cdf(student_t(degrees), t); }

double student_t_quantile(double probability, double degrees) {
    check_probability(probability);
    return boost::math::quantile(student_t(degrees), probability);
}

double chi_squared_quantile(double probability, double degrees) {
    check_probability(probability);
    if (!(degrees > 0)) fail("degrees of freedom must be above 0, not ", degrees);
    return boost::math::quantile(boost::math::chi_squared(degrees), probability);
}

double studentised_range_tail(double range, size_t count, double degrees) {
    if (count < 2 || !(degrees > 0)) fail("a studentised range needs two values and degrees of freedom above 0");
    if (!(range > 0)) return 1;
    // Over the estimate s of the standard deviation, whose square is chi-squared / degrees.
    const double constant = degrees / 2 * std::log(degrees / 2) - std::lgamma(degrees / 2) + std::log(2.0);
    const auto at = [&](double s) {
        return std::exp(constant + (degrees - 1) * std::log(s) - degrees * s * s / 2) *
               normal_range_tail(range * s, double(count));
    };
    return boost::math::quadrature::gauss<double, 60>::integrate(at, 0.0, 1 + 6 / std::sqrt(degrees));
}

double noncentral_t_cdf(double t, double degrees, double noncentrality) {
    if (!(degrees > 0)) fail("degrees of freedom must be above 0, not ", degrees);
    // Beside so large a mean the normal's scatter is lost: it changes the probability by its inverse square, 1e-6. The
    // series does not reach so far.
    constexpr double certain = 1e3;
    if (std::abs(noncentrality) < certain)
        return boost::math::cdf(boost::math::non_central_t(degrees, noncentrality), t);
    if (t * noncentrality <= 0) return noncentrality < 0 ? 1 : 0;
    const double ratio = noncentrality / t, squares = degrees * ratio * ratio;
    const boost::math::chi_squared distribution(degrees);
    return t > 0 ? boost::math::cdf(boost::math::complement(distribution, squares))
                 : boost::math::cdf(distribution, squares);
}
