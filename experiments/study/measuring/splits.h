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

/// Bias and variance, from all pairs of seeds (seed_pairs()), under each mask with finite pixels. Below two seeds there
/// are no rows, unless the point does not depend on seeds: then all of its error is bias.
///
/// Intervals are Student's over pairs of successive seeds, which are independent (two pairs or more), around the value
/// of all pairs, which scatters slightly less. The interval of the squared bias also includes, in quadrature, the
/// reference's noise (noise_half_width(); no interval where it is unknown) and the `lit_noise` of `mse`. `shared`:
/// shot, frame, technique, point and target.
std::vector<SplitRow> split_rows(const SeedSplit& split, std::span<const Mask> masks, const SplitRow& shared,
                                 bool depends_on_seed = true, const LitNoiseOfErrors& lit_noise = unknown_lit_noise);
