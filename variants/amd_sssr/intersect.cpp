#include "core/gbuffer/environment_images.h"
#include "variants/amd_sssr/passes.h"

void amd_intersect(PassGraph& graph, const GBuffer& gbuffer, const Image& pyramid, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories) {
    PassGraph::Pass pass = graph.compute("amd_sssr/intersect.comp");
    pass.read(pyramid)
        .read(noise)
        .read(histories.roughness.current)
        .read(gbuffer.lit)
        .write(histories.radiance.current);
    bind_environment(pass, gbuffer).use(work.ray_list).use(work.counters).dispatch(work.indirect_arguments);
}
