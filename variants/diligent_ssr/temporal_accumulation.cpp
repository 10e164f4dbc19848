#include "variants/diligent_ssr/targets.h"

DiligentHistories diligent_histories(PassGraph& graph, const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories;
    return {.radiance = graph.history("accumulated_radiance", is_float ? Format::rgba32f : Format::rgba16f),
            .variance = graph.history("accumulated_variance", is_float ? Format::r32f : Format::r16f)};
}

void diligent_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& reprojected_depth,
                         const DiligentResolved& resolved, const DiligentHistories& histories, const DiligentMask& mask,
                         const DiligentFilterParameters& parameters) {
    (void)graph, (void)gbuffer, (void)reprojected_depth, (void)resolved, (void)histories, (void)mask, (void)parameters;
}
