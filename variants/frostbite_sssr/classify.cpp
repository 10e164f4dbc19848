#include "variants/frostbite_sssr/passes.h"

FrostbiteTiles frostbite_classify(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images,
                                  const Image& color, const FrostbiteRayParameters& parameters, RayProbe* probe) {
    const glm::uvec2 extent = gbuffer.depth.extent, tiles = (extent + frostbite_tile - 1u) / frostbite_tile;
    const PassGraph::History ray_count = graph.history("ray_count", Format::r32f, tiles);
    if (!parameters.classification) {
        graph.clear(ray_count.current, glm::vec4(float(unsigned(parameters.max_rays))));
        return {ray_count.current};
    }
    const glm::uvec2 blocks = (extent + frostbite_probe_spacing - 1u) / frostbite_probe_spacing;
    const Image probes = graph.image_of("probes", Format::rg32f, blocks);
    PassGraph::Pass pass = graph.compute("frostbite_sssr/probe.comp");
    pass.read(color.as("hit_color")).write(probes).label("frostbite_sssr/classify");
    parameters.tracers.run(graph, pass, {"tracer", "rough_tracer"}, images, probe, 1,
                           [](PassGraph::Pass& probing) { probing.run(); });
    const PassGraph::History frames_left = graph.history("frames_left", Format::r32f, tiles);
    graph.compute("frostbite_sssr/count_rays.comp")
        .read(probes)
        .read(ray_count.previous)
        .read(frames_left.previous)
        .write(ray_count.current)
        .write(frames_left.current)
        .label("frostbite_sssr/classify")
        .run();
    return {ray_count.current};
}
