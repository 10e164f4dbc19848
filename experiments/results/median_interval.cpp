#include "experiments/results/median_interval.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

MedianInterval median_interval(std::vector<double> values) {
    if (values.empty()) fail("no values to take a median of");
    std::ranges::sort(values);
    const size_t n = values.size();
    const double median = n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
    // The largest r for which P(Binomial(n, 1/2) < r) <= 2.5 %: then [x_r, x_(n+1-r)] covers the median with at least
    // 95 %.
    double probability = std::pow(0.5, double(n)), cumulative = 0.0;
    size_t r = 0;
    while (cumulative + probability <= 0.025) {
        cumulative += probability;
        probability *= double(n - r) / double(r + 1);
        ++r;
    }
    r = std::max<size_t>(r, 1);
    return {median, values[r - 1], values[n - r]};
}
