#include "core/gbuffer/environment_images.h"
#include "variants/amd_sssr/passes.h"

void amd_intersect(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters,
                   RayProbe* probe) {
    PassGraph::Pass pass = graph.compute("amd_sssr/intersect.comp");
    pass.read(noise)
        .read(histories.roughness.current)
        .read(gbuffer.lit)
        .read(gbuffer.fallback)
        .write(histories.radiance.current);
    bind_environment(pass, gbuffer).use(work.ray_list).use(work.counters);
    parameters.tracers.run(graph, pass, {"tracer"}, images, probe, 1,
                           [&](PassGraph::Pass& tracing) { tracing.dispatch(work.indirect_arguments); });
}
