#include "experiments/gpu_costs/waves/pass_tracer.h"

#include <algorithm>

namespace {

// Of whole groups: their mean is known to some percent, and records of 4 kB a lane fit 128 MiB, the least that devices
// have.
constexpr unsigned traced_lanes = 1 << 15;

constexpr unsigned tile = 8;  // pixels, see TraceLayout

/// Words that a lane's decisions need: without a loop, each block decides at most once.
unsigned lane_words(const PipelineRecipe& simplified) {
    const ShaderFlow flow = flow_of(simplified);
    const std::vector<unsigned> depths = loop_depths(graph_of(flow));
    if (std::ranges::any_of(depths, [](unsigned depth) { return depth > 0; })) return TraceLayout().lane_words;
    unsigned decisions = 0;
    for (const ShaderFlow::Block& block : flow.blocks) decisions += block.decisions;
    return (decisions + 31) / 32;
}

}  // namespace

std::optional<InstrumentedPipeline> PassTracer::before(const PassRun& run) {
    const auto& [x, y, z] = run.recipe.local_size;
    const unsigned lanes = run.recipe.is_compute ? x * y * z : tile * tile;
    const glm::uvec3 groups = run.recipe.is_compute ? run.groups() : glm::uvec3((run.area + tile - 1u) / tile, 1);
    trace_ = {.stage = run.stage,
              .original = run.recipe,
              .recipe = simplified(run.recipe),
              .layout = trace_layout(groups, lanes, traced_lanes / lanes),
              .content = {}};
    const auto [entry, is_new] = traced_.try_emplace(bytes_of({trace_.recipe}));
    auto& [recipe, words] = entry->second;
    if (is_new) recipe = traced(trace_.recipe), words = lane_words(trace_.recipe);
    trace_.layout.lane_words = words;
    const auto layout = std::as_bytes(std::span(&trace_.layout, 1));
    return InstrumentedPipeline{.recipe = recipe,
                                .buffer = wave_trace_buffer,
                                .bytes = bytes_of(trace_.layout),
                                .begin = {layout.begin(), layout.end()}};
}

void PassTracer::after(const PassRun&, std::span<const std::byte> content) {
    trace_.content = content;
    observer_(trace_);
}
