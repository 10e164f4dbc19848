#include "tests/variants/diligent_trace.h"

DiligentTraced diligent_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                                    const HostImage& noise, const HostImage* color) {
    PassGraph graph(device, gbuffer.extent());
    DiligentParameters all;
    all.params.assign(parameters);
    const GBuffer uploaded = upload_gbuffer(graph, gbuffer);
    graph.begin_frame(gbuffer.camera, all.params, uploaded.images());
    const Image numbers = graph.image_of("blue_noise", Format::rg32f, noise.extent);
    graph.upload(numbers, noise);
    Image shown = uploaded.lit;
    if (color) {
        shown = graph.image("color", Format::rgba32f);
        graph.upload(shown, *color);
    }
    const Image hierarchy = diligent_depth_hierarchy(graph, uploaded, all.tracing);
    const DiligentMask mask = diligent_mask(graph, uploaded, all.tracing, all.filter);
    const DiligentRays rays = diligent_trace(graph, uploaded, hierarchy, numbers, shown, mask, all.tracing);
    return {graph.download(rays.radiance), graph.download(rays.direction)};
}
