#pragma once
#include "experiments/cell.h"
#include "metrics/statistics.h"

/// One target's images of all seeds, added one after the other. Each two successive seeds x, y tell by themselves, and
/// independently of the other pairs, the variance and, against the halves A, B of the reference, the squared bias:
/// their noises are independent, so E[(x - A)(y - B)] = bias^2.
struct SeedSplit {
    const MetricReference& reference;  ///< must outlive this
    SeedMoments moments = {};
    HostImage odd_one = {};  ///< a seed that waits for its partner; empty if none does
    /// Of each pair, mean over channels: (x - y)^2 / 2, and ((x - A)(y - B) + (y - A)(x - B)) / 2.
    std::vector<Plane> pair_variances = {}, pair_biases = {};

    void add(const HostImage& rgb);
};

/// split_error() under each mask that holds finite pixels; nothing below two seeds. Intervals are Student's over the
/// pairs of seeds (two or more), around the value that all seeds give; it is a little more certain than that of pairs.
/// That of the squared bias has the reference's noise added in quadrature. `shared` holds shot, frame, variant, point
/// and target.
std::vector<SplitRow> split_rows(const SeedSplit& split, std::span<const Mask> masks, const SplitRow& shared);
