#include "core/gbuffer/environment_images.h"
#include "variants/frostbite_sssr/passes.h"

namespace {

/// Groups of pixels that share rays, see taps.glsl.
glm::uvec2 groups_of(glm::uvec2 extent, const FrostbiteResolveParameters& parameters) {
    if (parameters.taps.is("1") || parameters.pattern.is("rotated")) return extent;
    if (parameters.pattern.is("quad_shared")) return (extent + 1u) / 2u;
    const unsigned farthest_move = 2;
    return (extent + farthest_move + 3u) / 4u * 2u;
}

}  // namespace

FrostbiteResolved frostbite_resolve(PassGraph& graph, const GBuffer& gbuffer, const Image& color,
                                    const Image& split_sum, const Image& below_horizon, const FrostbiteRays& rays,
                                    const FrostbiteResolveParameters& parameters) {
    const glm::uvec2 extent = gbuffer.depth.extent;
    const FrostbiteResolved resolved{graph.image("resolved_radiance", Format::rgba32f),
                                     graph.image("resolved_length", Format::r32f)};
    PassGraph::Pass pass = graph.compute("frostbite_sssr/resolve.comp");
    pass.read_linear(color.as("color_pyramid"))
        .read(split_sum)
        .read(below_horizon)
        .use(rays.directions)
        .use(rays.hits)
        .write(resolved.radiance)
        .write(resolved.reflection_depth);
    bind_environment(pass, gbuffer).run(groups_of(extent, parameters));
    return resolved;
}
