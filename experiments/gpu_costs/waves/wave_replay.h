#pragma once
#include "experiments/gpu_costs/spirv/shader_flow.h"

#include <span>

/// Counts of the waves of one group of invocations: a workgroup, or the fragments of a tile.
struct WaveCounts {
    std::vector<uint64_t> waves;  ///< runs by block: of waves with at least one lane
    std::vector<uint64_t> lanes;  ///< runs by block: of lanes
    uint64_t started = 0;         ///< waves with at least one lane that ran
    uint64_t cut = 0;             ///< lanes with more decisions than their trace holds; the rest is not counted
};

/// The decisions of one lane, from the lowest bit of the first word.
struct LaneTrace {
    bool has_run = false;
    uint64_t decisions = 0;  ///< number of decisions; `words` holds as many as fit
    std::span<const uint32_t> words;
};

/// Replays the lanes of a group as waves of `width` lanes, in their order. Among the blocks that its lanes have
/// reached, a wave runs the one of the lowest rank, with all lanes that are there; the others wait. Lanes thus rejoin
/// after a branch, and at the end of a loop's iteration even if some have left the loop. Chips that mask lanes by
/// program structure do the same, and so do Diamos et al. 2011, "SIMD Re-Convergence at Thread Frontiers". Other
/// simulators wait at the nearest post-dominator, which lies after the loop for every branch that may leave it.
WaveCounts replay(const ShaderFlow& flow, std::span<const LaneTrace> group, unsigned width);
