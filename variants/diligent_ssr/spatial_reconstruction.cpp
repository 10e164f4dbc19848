#include "variants/diligent_ssr/targets.h"

DiligentResolved diligent_reconstruct(PassGraph& graph, const GBuffer& gbuffer, const DiligentRays& rays,
                                      const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories, is_cleared = parameters.clear_targets;
    const auto target = [&](const char* name, Format format) {
        return diligent_target(graph, name, format, mask.full.extent, is_cleared);
    };
    const DiligentResolved resolved{
        .radiance = target("resolved_radiance", is_float ? Format::rgba32f : Format::rgba16f),
        .variance = target("resolved_variance", is_float ? Format::r32f : Format::r16f),
        .hit_depth = target("hit_depth", parameters.linear_hit_depth ? Format::r32f : Format::r16f)};
    auto pass = graph.fragment("diligent_ssr/spatial_reconstruction.frag");
    pass.read(gbuffer.depth)
        .read(gbuffer.normal)
        .read(mask.roughness)
        .read(rays.radiance)
        .read(rays.direction)
        .write(resolved.radiance)
        .write(resolved.variance)
        .write(resolved.hit_depth);
    draw_masked(pass, mask.full);
    return resolved;
}
