#pragma once
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// sum of term(i) for i < count, in double. Blocks of fixed size are summed in order, then their sums by Neumaier's
/// compensated summation (Neumaier 1974, ZAMM 54), so the result has the same bits for every number of threads.
template <class Term>
double ordered_sum(size_t count, const Term& term) {
    constexpr size_t block = 1024;
    std::vector<double> sums((count + block - 1) / block);
    tbb::parallel_for(size_t(0), sums.size(), [&](size_t b) {
        double sum = 0;
        for (size_t i = b * block; i < std::min(count, (b + 1) * block); ++i) sum += term(i);
        sums[b] = sum;
    });
    double total = 0, lost = 0;
    for (const double s : sums) {
        const double next = total + s;
        lost += std::abs(total) >= std::abs(s) ? (total - next) + s : (s - next) + total;
        total = next;
    }
    return total + lost;
}
