#include "groundtruth/sampling/alias_table.h"

#include <algorithm>
#include <cmath>

AliasTable::AliasTable(std::span<const double> weights) {
    double sum = 0;
    for (double weight : weights) sum += weight;
    if (!(sum > 0)) return;

    const size_t count = weights.size();
    entries_.resize(count);
    size_ = uint32_t(count);
    probabilities_.resize(count);
    std::vector<double> share(count);  // of a slot; the mean is 1
    std::vector<uint32_t> small, large;
    for (size_t i = 0; i < count; ++i) {
        probabilities_[i] = weights[i] / sum;
        share[i] = probabilities_[i] * double(count);
        (share[i] < 1 ? small : large).push_back(uint32_t(i));
    }
    const auto set = [&](uint32_t slot, double keep, uint32_t alias) {
        const double threshold = std::min(std::floor(keep * 0x1p32), 4294967295.0);
        entries_[slot] = {uint32_t(threshold), alias, threshold > 0 ? 0x1p32 / threshold : 0,
                          0x1p32 / (0x1p32 - threshold)};
    };
    while (!small.empty() && !large.empty()) {
        const uint32_t from = small.back(), to = large.back();
        small.pop_back();
        set(from, share[from], to);
        share[to] -= 1 - share[from];
        if (share[to] < 1) {
            large.pop_back();
            small.push_back(to);
        }
    }
    // What remains differs from a full slot only by rounding, unless its weight is zero.
    const uint32_t heaviest = uint32_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
    for (uint32_t slot : small) set(slot, weights[slot] > 0 ? 1 : 0, heaviest);
    for (uint32_t slot : large) set(slot, 1, slot);
}
