#include "variants/diligent_ssr/targets.h"

DiligentHistories diligent_histories(PassGraph& graph, const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories;
    return {.radiance = graph.history("accumulated_radiance", is_float ? Format::rgba32f : Format::rgba16f),
            .variance = graph.history("accumulated_variance", is_float ? Format::r32f : Format::r16f)};
}

void diligent_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& reprojected_depth,
                         const DiligentResolved& resolved, const DiligentHistories& histories, const DiligentMask& mask,
                         const DiligentFilterParameters& parameters) {
    if (parameters.clear_targets) {
        graph.clear(histories.radiance.current, {});
        graph.clear(histories.variance.current, {});
    }
    const Sampling between_texels{.is_linear = !parameters.float_histories};
    auto pass = graph.fragment("diligent_ssr/temporal_accumulation.frag");
    pass.read(gbuffer.motion)
        .read(gbuffer.previous_depth)
        .read(reprojected_depth)
        .read(resolved.radiance)
        .read(resolved.variance)
        .read(resolved.hit_depth)
        .read(histories.radiance.previous, between_texels)
        .read(histories.variance.previous, between_texels)
        .write(histories.radiance.current)
        .write(histories.variance.current);
    draw_masked(pass, mask.full);
}
