#include "variants/frostbite_sssr/passes.h"

FrostbiteRays frostbite_trace(PassGraph& graph, const DepthPyramids& depths, const FrostbiteWork& work,
                              const Image& below_horizon, const FrostbiteRayParameters& parameters) {
    const size_t rays = size_t(work.extent.x) * work.extent.y * parameters.max_rays;
    const FrostbiteRays traced{.directions = graph.buffer("directions", rays * 16),
                               .hits = graph.buffer("hits", rays * 16)};
    graph.clear(traced.directions, 0);  // of rays that no list has
    graph.compute("frostbite_sssr/trace_hierarchical.comp")
        .read(depths.nearest)
        .read(depths.farthest)
        .read(below_horizon)
        .use(work.hierarchical_list)
        .use(work.counters)
        .use(traced.directions)
        .use(traced.hits)
        .dispatch(work.indirect_arguments);
    graph.compute("frostbite_sssr/trace_linear.comp")
        .read(below_horizon)
        .use(work.linear_list)
        .use(work.counters)
        .use(traced.directions)
        .use(traced.hits)
        .dispatch(work.indirect_arguments, 12);
    return traced;
}
