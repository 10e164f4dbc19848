#include "core/gbuffer/environment_images.h"
#include "variants/diligent_ssr/targets.h"

DiligentRays diligent_trace(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& hierarchies,
                            const Image& noise, const Image& color, const DiligentMask& mask,
                            const DiligentTracingParameters& parameters, RayProbe* probe) {
    const Format format = parameters.float_rays ? Format::rgba32f : Format::rgba16f;
    const DiligentRays rays{.radiance = diligent_target(graph, "ray_radiance", format, mask.traced.extent, true),
                            .direction = diligent_target(graph, "ray_direction", format, mask.traced.extent, true)};
    auto pass = graph.fragment("diligent_ssr/intersection.frag");
    pass.read(noise)
        .read(color.as("hit_color"))
        .read(mask.roughness)
        .read(gbuffer.normal)
        .read(gbuffer.geometric_normal)
        .read(gbuffer.motion)
        .write(rays.radiance)
        .write(rays.direction);
    bind_environment(pass, gbuffer);
    parameters.tracers.run(graph, pass, {"tracer"}, hierarchies, probe, 1,
                           [&](PassGraph::Pass& tracing) { draw_masked(tracing, mask.traced); });
    return rays;
}
