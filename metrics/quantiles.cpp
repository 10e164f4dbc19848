#include "metrics/quantiles.h"

#include "core/error.h"

#include <cmath>
#include <limits>

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double tiny = 1e-300;  // keeps the denominators of Lentz's method away from 0

/// b0 + a1 / (b1 + a2 / (b2 + ...)) by the modified Lentz method (Thompson, Barnett 1986, J. Comput. Phys. 64).
/// `term(n)` gives a_n and b_n for n >= 1.
struct Term {
    double a, b;
};
template <class TermAt>
double continued_fraction(double b0, const TermAt& term) {
    const auto away_from_zero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
    double value = away_from_zero(b0), c = value, d = 0;
    for (int n = 1; n < 100000; ++n) {
        const auto [a, b] = term(n);
        d = 1 / away_from_zero(b + a * d);
        c = away_from_zero(b + a / c);
        value *= c * d;
        if (std::abs(c * d - 1) < 2 * epsilon) break;
    }
    return value;
}

/// Regularised incomplete beta function I_x(a, b), by the continued fraction DLMF 8.17.22.
double incomplete_beta(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2))
        return 1 - incomplete_beta(b, a, 1 - x);  // DLMF 8.17.4, where the fraction converges fast
    const auto term = [=](int n) -> Term {
        const double m = n / 2;
        if (n % 2 == 0) return {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)), 1};
        return {-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)), 1};
    };
    const double front =
        std::exp(a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b)) / a;
    return front / continued_fraction(1, term);
}

/// The x at which the increasing function reaches the probability, by bisection between bounds that are widened first.
template <class Cdf>
double inverse(const Cdf& cdf, double probability, double low, double high) {
    if (!(probability > 0 && probability < 1)) fail("a quantile needs a probability within (0, 1), not ", probability);
    while (cdf(low) > probability) low *= 2;
    while (cdf(high) < probability) high *= 2;
    for (int i = 0; i < 200 && high - low > 2 * epsilon * std::max(std::abs(low), std::abs(high)); ++i) {
        const double middle = low + (high - low) / 2;
        (cdf(middle) < probability ? low : high) = middle;
    }
    return low + (high - low) / 2;
}

void check_degrees(double degrees) {
    if (!(degrees > 0)) fail("degrees of freedom must be above 0, not ", degrees);
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

double normal_quantile(double probability) { return inverse(normal_cdf, probability, -1, 1); }

double student_t_cdf(double t, double degrees) {
    check_degrees(degrees);
    const double tail = incomplete_beta(degrees / 2, 0.5, degrees / (degrees + t * t)) / 2;
    return t < 0 ? tail : 1 - tail;
}

double student_t_quantile(double probability, double degrees) {
    check_degrees(degrees);
    return inverse([=](double t) { return student_t_cdf(t, degrees); }, probability, -1, 1);
}
