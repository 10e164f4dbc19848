#include "core/gbuffer/environment_images.h"
#include "variants/amd_sssr/passes.h"

void amd_intersect(PassGraph& graph, const GBuffer& gbuffer, const Image& pyramid, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters) {
    const Image steps =
        graph.image_of("march_steps", Format::r32f, parameters.count_steps ? graph.extent() : glm::uvec2(1));
    if (parameters.count_steps) graph.clear(steps, {});
    PassGraph::Pass pass = graph.compute("amd_sssr/intersect.comp");
    pass.read(pyramid)
        .read(noise)
        .read(histories.roughness.current)
        .read(gbuffer.lit)
        .read(gbuffer.fallback)
        .write(histories.radiance.current)
        .write(steps);
    bind_environment(pass, gbuffer).use(work.ray_list).use(work.counters).dispatch(work.indirect_arguments);
}
