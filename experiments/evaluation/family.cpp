#include "experiments/evaluation/family.h"

#include <algorithm>
#include <numeric>

std::vector<double> adjusted_for_choice(std::span<const AgainstBest> comparisons, std::span<const size_t> points) {
    std::vector<size_t> order(comparisons.size()), remaining(points.begin(), points.end());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return comparisons[i].p; });
    const auto pairs_of = [](size_t n) { return double(n) * (double(n) - 1) / 2; };
    double pairs = 0, greatest = 0;
    for (const size_t n : remaining) pairs += pairs_of(n);
    std::vector<double> adjusted(comparisons.size());
    for (const size_t i : order) {
        greatest = std::max(greatest, pairs * comparisons[i].p);
        adjusted[i] = std::min(1.0, greatest);
        size_t& left = remaining[comparisons[i].contest];
        pairs -= pairs_of(left) - pairs_of(left - 1);
        --left;
    }
    return adjusted;
}
