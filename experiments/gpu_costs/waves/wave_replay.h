#pragma once
#include "experiments/gpu_costs/spirv/shader_flow.h"

#include <span>

/// What the waves of one group of invocations did: a workgroup, or the fragments of a tile.
struct WaveCounts {
    std::vector<uint64_t> waves;  ///< by block: how often a wave ran it, with one or more of its lanes
    std::vector<uint64_t> lanes;  ///< the same, of lanes
    uint64_t started = 0;         ///< waves with one or more lanes that ran
    uint64_t cut = 0;             ///< lanes that decided more than their trace holds; nothing is counted after it
};

/// The trace of one lane: the decisions that it made, from the lowest bit of the first word on.
struct LaneTrace {
    bool has_run = false;
    uint64_t decisions = 0;  ///< that it made; `words` hold those that there was room for
    std::span<const uint32_t> words;
};

/// Runs the lanes of a group again as waves of `width` lanes, in their order. Of the blocks that lanes are at, a wave
/// runs the one of the lowest rank, with all lanes that are there; the others wait. So lanes go on together behind a
/// branch, and at the end of a loop's turn, also where some of them have left the loop: as chips do it that mask lanes
/// out by the structure of the program, and as Diamos et al. 2011, "SIMD Re-Convergence at Thread Frontiers", do it.
/// The nearest post-dominator, which other simulators wait at, lies behind the loop for every branch that may leave it.
WaveCounts replay(const ShaderFlow& flow, std::span<const LaneTrace> group, unsigned width);
