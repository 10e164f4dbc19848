#include "variants/diligent_ssr/passes.h"

Image diligent_reprojected_depth(PassGraph& graph, const GBuffer& gbuffer) {
    const Image reprojected = graph.image("reprojected_depth", Format::r32f);
    graph.fragment("diligent_ssr/reprojected_depth.frag").read(gbuffer.depth).write(reprojected).run();
    return reprojected;
}
