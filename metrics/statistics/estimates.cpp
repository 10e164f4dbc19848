#include "metrics/statistics/estimates.h"

#include "core/error.h"
#include "metrics/statistics/quantiles.h"
#include "metrics/statistics/summation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

struct Moments {
    double mean, standard_error;
};

Moments moments(std::span<const double> values) {
    if (values.size() < 2) fail("a confidence interval needs at least two values, found ", values.size());
    const double n = double(values.size());
    const double mean = ordered_sum(values.size(), [&](size_t i) { return values[i]; }) / n;
    const double squares =
        ordered_sum(values.size(), [&](size_t i) { return (values[i] - mean) * (values[i] - mean); });
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

Estimate interval(const Moments& m, size_t count) {
    const double half_width = student_t_quantile(0.975, double(count - 1)) * m.standard_error;
    return {m.mean, m.mean - half_width, m.mean + half_width};
}

}  // namespace

Estimate mean_estimate(std::span<const double> values) { return interval(moments(values), values.size()); }

Jackknifed jackknifed_mean(std::span<const double> values) {
    const auto mean_without = [&](size_t left_out) {  // no subtraction from the sum: one value may be nearly all of it
        const bool is_one_left_out = left_out < values.size();
        const double sum = ordered_sum(values.size(), [&](size_t i) { return i == left_out ? 0.0 : values[i]; });
        return sum / double(values.size() - is_one_left_out);
    };
    Jackknifed mean{.value = mean_without(values.size()), .without = {}};
    for (size_t i = 0; i < values.size() && values.size() > 1; ++i) mean.without.push_back(mean_without(i));
    return mean;
}

std::pair<double, double> RatioEstimate::interval(double error) const {
    const double half_width = student_t_quantile(1 - error / 2, degrees) * standard_error, logarithm = std::log(value);
    return {std::exp(logarithm - half_width - excess_of_a), std::exp(logarithm + half_width + excess_of_b)};
}

double RatioEstimate::p_outside(double most) const {
    const double logarithm = std::log(value);
    const double unexplained = std::max({logarithm - std::log(most) - excess_of_a, -logarithm - excess_of_b, 0.0});
    if (unexplained == 0 || !(standard_error > 0)) return unexplained > 0 ? 0 : 1;
    return 2 * student_t_cdf(-unexplained / standard_error, degrees);
}

SharedScatter scatter_of_terms(std::span<const double> changes, double terms) {
    double squares = 0, fourths = 0;
    for (const double change : changes) squares += change * change, fourths += std::pow(change, 4);
    if (squares == 0) return {};
    return {.variance = squares, .degrees = std::clamp(3 * squares * squares / fourths, 1.0, terms)};
}

double p_beyond_limits(double value, double limit, double standard_error, double degrees, double down, double up) {
    const double within = limit - std::max(value + up, down - value);  // of the end that is nearer to its limit
    if (!(standard_error > 0)) return within > 0 ? 0 : 1;
    return student_t_cdf(-within / standard_error, degrees);
}

double RatioEstimate::p_beyond(double margin) const {
    return p_beyond_limits(std::log(value), std::log1p(margin), standard_error, degrees, excess_of_a, excess_of_b);
}

RatioEstimate jackknifed_ratio(const Jackknifed& a, const Jackknifed& b, const SharedScatter& shared) {
    if (a.without.size() != b.without.size())
        fail("a paired comparison needs as many seeds on each side, found ", a.without.size(), " and ",
             b.without.size());
    if (!(a.value > 0 && b.value > 0)) fail("a ratio needs values above 0, found ", a.value, " and ", b.value);
    RatioEstimate ratio{.value = a.value / b.value, .low = {}, .high = {}, .p_value = {}};
    const size_t n = a.without.size();
    std::vector<double> logarithms;
    for (size_t i = 0; i < n; ++i)
        if (a.without[i] > 0 && b.without[i] > 0) logarithms.push_back(std::log(a.without[i] / b.without[i]));
    if (logarithms.size() < n || (n < 2 && shared.variance <= 0)) return ratio;
    // Values without one seed share all others and scatter N - 1 times less than single seeds would.
    const double of_seeds = n < 2 ? 0.0 : moments(logarithms).standard_error * double(n - 1);
    const double variance = of_seeds * of_seeds + shared.variance;
    const double degrees_share =
        (n < 2 ? 0.0 : std::pow(of_seeds, 4) / double(n - 1)) + shared.variance * shared.variance / shared.degrees;
    const double degrees = degrees_share > 0 ? variance * variance / degrees_share : double(n - 1);
    const double down = -std::log1p(-shared.excess_of_a), up = -std::log1p(-shared.excess_of_b);
    ratio.standard_error = std::sqrt(variance), ratio.degrees = degrees;
    ratio.excess_of_a = down, ratio.excess_of_b = up;
    const auto [low, high] = ratio.interval(0.05);
    if (!std::isfinite(high)) return ratio;
    ratio.low = low, ratio.high = high;
    ratio.p_value = ratio.p_outside(1);
    return ratio;
}

std::vector<double> holm_adjusted(std::span<const double> p_values, size_t others) {
    std::vector<size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return p_values[i]; });
    std::vector<double> adjusted(p_values.size());
    double greatest = 0;
    for (size_t rank = 0; rank < order.size(); ++rank) {
        greatest = std::max(greatest, double(others + order.size() - rank) * p_values[order[rank]]);
        adjusted[order[rank]] = std::min(1.0, greatest);
    }
    return adjusted;
}
