#pragma once
#include "experiments/gpu_costs/waves/wave_replay.h"

/// The storage buffer of a traced pipeline: a TraceLayout, then the records of the lanes of the chosen groups, each of
/// 1 + lane_words words: 1 + the number of its decisions (0: it never ran), then these as bits.
inline constexpr const char* wave_trace_buffer = "wave_trace";

/// Which groups write a record, and where. A group is a workgroup, or 8 x 8 pixels of a fragment pass, of which 64
/// lanes in the order of a wave: quads of 2 x 2, four in a row. Group g is chosen if (g * step) mod groups < chosen,
/// and that is the place of its records; with `step` prime to `groups` so many are, spread over the frame.
struct TraceLayout {
    uint32_t groups_x = 1, groups_y = 1;  ///< of a row and of a slice
    uint32_t groups = 0, chosen = 0, step = 1;
    uint32_t lanes = 64;         ///< of a group
    uint32_t lane_words = 1000;  ///< 32 decisions each; 2^15 lanes fit the 128 MiB that each device has for a buffer
    uint32_t unused = 0;
};

/// Of a pass with so many groups by dimension: `chosen` of them at most.
TraceLayout trace_layout(glm::uvec3 groups, unsigned lanes, unsigned chosen);
size_t bytes_of(const TraceLayout& layout);

/// The pipeline, which simplified() gave, with the buffer among its resources; each decision of a lane is added to its
/// record. It computes the same bits. Fragment shaders without a discard and without a depth of their own are made to
/// be tested before they run, as those that count.
PipelineRecipe traced(const PipelineRecipe& simplified);

/// What the chosen groups of one run of a pass decided.
struct PassTrace {
    std::string stage;
    PipelineRecipe original, recipe;  ///< as the pass has it, and as simplified() gave it
    TraceLayout layout;
    std::vector<uint32_t> content;  ///< of the buffer
};

/// The records of the chosen group at `place`, in a buffer's content.
std::vector<LaneTrace> lanes_of(const TraceLayout& layout, std::span<const uint32_t> content, unsigned place);
