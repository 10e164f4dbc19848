#include "variants/diligent_ssr/targets.h"

DiligentResolved diligent_reconstruct(PassGraph& graph, const GBuffer& gbuffer, const DiligentRays& rays,
                                      const DiligentMask& mask, const DiligentTracingParameters& tracing,
                                      const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories, is_cleared = parameters.clear_targets;
    const auto target = [&](const char* name, Format format) {
        return diligent_target(graph, name, format, mask.full.extent, is_cleared);
    };
    const DiligentResolved resolved{
        .radiance = target("resolved_radiance", is_float ? Format::rgba32f : Format::rgba16f),
        .variance = target("resolved_variance", is_float ? Format::r32f : Format::r16f),
        .hit_depth = target("hit_depth", parameters.linear_hit_depth ? Format::r32f : Format::r16f)};
    (void)gbuffer, (void)rays, (void)tracing;
    return resolved;
}
