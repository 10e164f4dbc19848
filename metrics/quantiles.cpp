#include "metrics/quantiles.h"

#include "core/error.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace {

void check_probability(double probability) {
    if (!(probability > 0 && probability < 1)) fail("a quantile needs a probability within (0, 1), not ", probability);
}

boost::math::students_t student_t(double degrees) {
    if (!(degrees > 0)) fail("degrees of freedom must be above 0, not ", degrees);
    return boost::math::students_t(degrees);
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
