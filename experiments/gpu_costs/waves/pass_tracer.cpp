#include "experiments/gpu_costs/waves/pass_tracer.h"

namespace {

// Of whole groups: their mean is known to some percent, and records of 4 kB a lane fit 128 MiB, the least that devices
// have.
constexpr unsigned traced_lanes = 1 << 15;

constexpr unsigned tile = 8;  // pixels, see TraceLayout

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
    const auto [recipe, is_new] = traced_.try_emplace(bytes_of({trace_.recipe}));
    if (is_new) recipe->second = traced(trace_.recipe);
    const auto layout = std::as_bytes(std::span(&trace_.layout, 1));
    return InstrumentedPipeline{.recipe = recipe->second,
                                .buffer = wave_trace_buffer,
                                .bytes = bytes_of(trace_.layout),
                                .begin = {layout.begin(), layout.end()}};
}

void PassTracer::after(const PassRun&, std::vector<std::byte> content) {
    trace_.content = std::move(content);
    observer_(trace_);
}
