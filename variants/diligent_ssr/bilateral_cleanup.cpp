#include "variants/diligent_ssr/targets.h"

Image diligent_cleanup(PassGraph& graph, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    const Image reflections = diligent_target(
        graph, "reflections", parameters.float_histories ? Format::rgba32f : Format::rgba16f, mask.full.extent, true);
    (void)gbuffer, (void)radiance, (void)variance;
    return reflections;
}
