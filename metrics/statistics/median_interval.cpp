#include "metrics/statistics/median_interval.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

std::vector<double> in_order_of_size(std::span<const double> values) {
    if (values.empty()) fail("no values to take a median of");
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return sorted;
}

double median_of(const std::vector<double>& sorted) {
    const size_t n = sorted.size();
    return n % 2 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

}  // namespace

double sign_variance_factor(std::span<const double> values) {
    const double median = median_of(in_order_of_size(values));
    const size_t n = values.size();
    const auto sign = [&](size_t i) { return double(values[i] > median) - double(values[i] < median); };
    double factor = 1;
    for (size_t lag = 1; lag < n / 2; ++lag) {
        double sum = 0;
        for (size_t i = lag; i < n; ++i) sum += sign(i) * sign(i - lag);
        const double correlation = (sum + 1) / double(n);  // signs about their own median are anticorrelated by 1 / n
        if (correlation <= 0) break;
        factor += 2 * correlation;
    }
    return std::max(factor, 2.0);
}

Estimate median_interval(std::span<const double> in_order_of_time) {
    const std::vector<double> sorted = in_order_of_size(in_order_of_time);
    const size_t n = sorted.size();
    Estimate m{.value = median_of(sorted)};
    const double half_width = 1.96 * std::sqrt(sign_variance_factor(in_order_of_time) * double(n)) / 2;
    const double rank = std::max(0.0, std::floor(double(n) / 2 - half_width));
    m.low = sorted[size_t(rank)], m.high = sorted[n - 1 - size_t(rank)];
    return m;
}
