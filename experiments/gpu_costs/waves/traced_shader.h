#pragma once
#include "experiments/gpu_costs/waves/wave_replay.h"

/// The storage buffer of a traced pipeline: a TraceLayout, then records of the lanes of the chosen groups. A record has
/// 1 + lane_words words: 1 + the number of decisions (0: the lane never ran), then the decisions as bits.
inline constexpr const char* wave_trace_buffer = "wave_trace";

/// Which groups write records, and where. A group is a workgroup, or 8 x 8 pixels of a fragment pass: 64 lanes in a
/// wave's order, in quads of 2 x 2, four in a row. Group g is chosen if (g * step) mod groups < chosen; this value is
/// the place of its records. With `step` prime to `groups`, exactly `chosen` groups are chosen, spread over the frame.
struct TraceLayout {
    uint32_t groups_x = 1, groups_y = 1;  ///< groups in a row; groups in a slice
    uint32_t groups = 0, chosen = 0, step = 1;
    uint32_t lanes = 64;         ///< of a group
    uint32_t lane_words = 1000;  ///< 32 decisions each; 2^15 lanes fit 128 MiB, which every device has for a buffer
    uint32_t unused = 0;
};

/// The layout for a pass with these groups by dimension; at most `chosen` are chosen.
TraceLayout trace_layout(glm::uvec3 groups, unsigned lanes, unsigned chosen);
size_t bytes_of(const TraceLayout& layout);

/// A simplified() pipeline with the trace buffer, to which each lane adds its decisions. It computes the same bits.
/// Fragment shaders without discard and without their own depth are set to be tested before they run.
PipelineRecipe traced(const PipelineRecipe& simplified);

/// The decisions of the chosen groups in one run of a pass.
struct PassTrace {
    std::string stage;
    PipelineRecipe original, recipe;  ///< the pass's own, and simplified() of it
    TraceLayout layout;
    std::span<const std::byte> content;  ///< of the buffer; it lives until the observer returns
};

/// The traces of the lanes of the chosen group at `place`.
std::vector<LaneTrace> lanes_of(const TraceLayout& layout, std::span<const std::byte> content, unsigned place);
