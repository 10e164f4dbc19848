#pragma once
#include "experiments/cell.h"
#include "metrics/statistics.h"

/// One target's images of all seeds, added one after the other.
struct SeedSplit {
    SeedMoments moments;
    HostImage odd_one;                  ///< a seed that waits for its partner; empty if none does
    std::vector<Plane> pair_variances;  ///< (x_i - x_j)^2 / 2, mean over channels, of each two successive seeds

    void add(const HostImage& rgb);
};

/// split_error() under each mask that holds finite pixels; nothing below two seeds. Each pair of seeds is an estimate
/// of the variance by itself, and independent of the other pairs: the interval is Student's over them (two pairs or
/// more), around their mean, moved to the variance over all seeds, which wastes nothing and is hence a little more
/// certain than it says. `shared` holds shot, frame, variant, point and target.
std::vector<SplitRow> split_rows(const SeedSplit& split, const MetricReference& reference, std::span<const Mask> masks,
                                 const SplitRow& shared);
