#include "variants/diligent_ssr/targets.h"

Image diligent_cleanup(PassGraph& graph, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    const Format format = parameters.float_histories ? Format::rgba32f : Format::rgba16f;
    const Image reflections = diligent_target(graph, "reflections", format, mask.full.extent, true);
    auto pass = graph.fragment("diligent_ssr/bilateral_cleanup.frag");
    pass.read(gbuffer.depth)
        .read(gbuffer.normal)
        .read(mask.roughness)
        .read(radiance.as("accumulated_radiance"))
        .read(variance.as("accumulated_variance"))
        .write(reflections);
    draw_masked(pass, mask.full);
    return reflections;
}
