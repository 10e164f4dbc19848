#include "variants/frostbite_sssr/passes.h"

FrostbiteRays frostbite_trace(PassGraph& graph, const Tracers::Images& images, const FrostbiteWork& work,
                              const Image& below_horizon, const FrostbiteRayParameters& parameters, RayProbe* probe) {
    const size_t rays = size_t(work.extent.x) * work.extent.y * parameters.max_rays;
    const FrostbiteRays traced{.directions = graph.buffer("directions", rays * 16),
                               .hits = graph.buffer("hits", rays * 16)};
    graph.clear(traced.directions, 0);  // of rays that no list has
    const auto trace = [&](const char* shader, const char* slot, const Buffer& list, size_t arguments) {
        PassGraph::Pass pass = graph.compute(shader);
        pass.read(below_horizon).use(list).use(work.counters).use(traced.directions).use(traced.hits);
        parameters.tracers.run(graph, pass, {slot}, images, probe, parameters.max_rays,
                               [&](PassGraph::Pass& tracing) { tracing.dispatch(work.indirect_arguments, arguments); });
    };
    if (work.has_smooth) trace("frostbite_sssr/trace_smooth.comp", "tracer", work.smooth_list, 0);
    if (work.has_rough) trace("frostbite_sssr/trace_rough.comp", "rough_tracer", work.rough_list, 12);
    return traced;
}
