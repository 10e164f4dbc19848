#include "variants/diligent_ssr/targets.h"

DiligentMask diligent_mask(PassGraph& graph, const GBuffer& gbuffer, const DiligentTracingParameters& parameters) {
    const Format format = parameters.mask.is("stencil") ? Format::d32f_s8 : Format::d16;
    (void)gbuffer;
    return {.roughness = graph.image("roughness", parameters.float_roughness ? Format::r32f : Format::r8),
            .full = graph.image("mask", format),
            .traced = graph.image("mask", format)};
}
