#include "variants/frostbite_sssr/passes.h"

FrostbiteWork frostbite_allocate(PassGraph& graph, const GBuffer& gbuffer, const FrostbiteTiles& tiles,
                                 const FrostbiteRayParameters& parameters) {
    const glm::uvec2 screen = gbuffer.depth.extent, extent = parameters.half_resolution ? (screen + 1u) / 2u : screen;
    const size_t list_bytes = size_t(extent.x) * extent.y * parameters.max_rays * 4;
    const FrostbiteWork work{.smooth_list = graph.buffer("smooth_list", list_bytes),
                             .rough_list = graph.buffer("rough_list", list_bytes),
                             .counters = graph.buffer("counters", 8),
                             .indirect_arguments = graph.buffer("indirect_arguments", 24),
                             .extent = extent};
    graph.clear(work.counters, 0);
    graph.compute("frostbite_sssr/allocate.comp")
        .read(tiles.ray_count)
        .use(work.smooth_list)
        .use(work.rough_list)
        .use(work.counters)
        .run(extent);
    graph.compute("frostbite_sssr/prepare_arguments.comp")
        .use(work.counters)
        .use(work.indirect_arguments)
        .label("frostbite_sssr/allocate")
        .dispatch_groups({1, 1, 1});
    return work;
}
