#pragma once
#include "groundtruth/sampling/prefetch.h"

#include <cstdint>
#include <span>
#include <vector>

/// Draws an index with probability proportional to its weight in constant time (Walker 1977; Vose 1991). Returns the
/// unused part of the random number, so that one number chooses a light and places a point on it. A separate number for
/// the choice would lose most of the gain of a low-discrepancy sequence.
class AliasTable {
public:
    AliasTable() = default;
    /// Weights >= 0, finite; if all are zero the table is empty.
    explicit AliasTable(std::span<const double> weights);

    struct Choice {
        uint32_t index;
        uint32_t rest;  ///< uniform 32-bit fixed point
    };
    Choice sample(uint32_t bits) const {
        const uint64_t product = uint64_t(bits) * size_;
        const uint32_t slot = uint32_t(product >> 32), fraction = uint32_t(product);
        const Entry& entry = entries_[slot];
        if (fraction < entry.threshold) return {slot, uint32_t(fraction * entry.scale_below)};
        return {entry.alias, uint32_t((fraction - entry.threshold) * entry.scale_above)};
    }
    /// Prefetches what sample() will read.
    void prefetch(uint32_t bits) const { prefetch_line(&entries_[uint64_t(bits) * size_ >> 32]); }
    bool empty() const { return size_ == 0; }
    double probability(size_t index) const { return probabilities_[index]; }

private:
    struct Entry {
        uint32_t threshold, alias;  ///< fractions below the threshold keep the slot
        double scale_below, scale_above;
    };
    std::vector<Entry> entries_;
    uint32_t size_ = 0;
    std::vector<double> probabilities_;
};
