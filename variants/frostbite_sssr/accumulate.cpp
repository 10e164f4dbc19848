#include "variants/frostbite_sssr/passes.h"

Image frostbite_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& split_sum,
                           const FrostbiteResolved& resolved, const FrostbiteResolveParameters& parameters) {
    if (!parameters.temporal_filter && parameters.reflectance_after_filter) return resolved.radiance;
    const PassGraph::History accumulated = graph.history("accumulated", Format::rgba32f);
    const Image reflections = graph.image("reflections", Format::rgba32f);
    graph.compute("frostbite_sssr/accumulate.comp")
        .read(gbuffer.motion)
        .read(gbuffer.previous_depth)
        .read(gbuffer.previous_normal)
        .read(split_sum)
        .read(resolved.radiance)
        .read(resolved.reflection_depth)
        .read(accumulated.previous)
        .write(accumulated.current)
        .write(reflections)
        .run();
    return reflections;
}
