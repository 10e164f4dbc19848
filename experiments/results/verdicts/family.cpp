#include "experiments/results/verdicts/family.h"

#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

double pairs_of(size_t n) { return double(n) * (double(n) - 1) / 2; }

/// The p of the pair as the largest difference of `n` points.
double p_of_range(const AgainstBest& pair, size_t n) {
    const double all = std::min(1.0, pairs_of(n) * pair.p);
    if (!(pair.degrees > 0) || n < 3 || !(pair.p > 0)) return all;
    const double t = -student_t_quantile(std::max(pair.p / 2, 1e-300), pair.degrees);
    return std::min(all, studentised_range_tail(t * std::sqrt(2.0), n, pair.degrees));
}

}  // namespace

std::vector<double> adjusted_for_choice(std::span<const AgainstBest> comparisons, std::span<const size_t> points) {
    std::vector<size_t> order(comparisons.size()), remaining(points.begin(), points.end());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return comparisons[i].p; });
    double pairs = 0, greatest = 0;
    for (const size_t n : remaining) pairs += pairs_of(n);
    std::vector<double> adjusted(comparisons.size());
    for (const size_t i : order) {
        size_t& left = remaining[comparisons[i].contest];
        const double elsewhere = pairs - pairs_of(left);
        greatest = std::max(greatest, p_of_range(comparisons[i], left) + elsewhere * comparisons[i].p);
        adjusted[i] = std::min(1.0, greatest);
        pairs -= double(left - 1);
        --left;
    }
    return adjusted;
}
