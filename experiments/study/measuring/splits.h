#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/study/measuring/lit_noise.h"
#include "metrics/score.h"

/// One target's images of all seeds, added one after the other.
struct SeedSplit {
    const MetricReference& reference;  ///< must outlive this
    SeedMoments moments = {};
    std::vector<unsigned> seeds = {};
    std::vector<HostImage> images = {};

    void add(unsigned seed, const HostImage& rgb);
};

/// Estimates from all pairs of seeds (seed_pairs()) under each mask with finite pixels; nothing below two seeds, except
/// of a point that does not depend on them: all of its error is bias. Intervals are
/// Student's over the pairs of successive seeds, which are independent (two pairs or more), around the value of all
/// pairs, which has slightly less scatter. That of the squared bias has the reference's noise added in quadrature
/// (noise_half_width(); none where that is unknown), and the `lit_noise` of `mse`. `shared` holds shot,
/// frame, technique, point and target.
std::vector<SplitRow> split_rows(const SeedSplit& split, std::span<const Mask> masks, const SplitRow& shared,
                                 bool depends_on_seed = true, const LitNoiseOfErrors& lit_noise = unknown_lit_noise);
