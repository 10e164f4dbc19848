#include "tests/variants/diligent_trace.h"

#include "tests/variants/diligent_frames.h"

DiligentTraced diligent_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                                    const HostImage& noise, const HostImage* color) {
    DiligentFrames frame(device, gbuffer.extent(), parameters);
    frame.begin(gbuffer);
    PassGraph& graph = frame.graph;
    const DiligentTracingParameters& tracing = frame.parameters.tracing;
    const Image numbers = graph.image_of("blue_noise", Format::rg32f, noise.extent);
    graph.upload(numbers, noise);
    Image shown = frame.gbuffer.lit;
    if (color) {
        shown = graph.image("color", Format::rgba32f);
        graph.upload(shown, *color);
    }
    const Tracers::Images hierarchies = diligent_depth_hierarchies(graph, frame.gbuffer, tracing);
    const DiligentRays rays = diligent_trace(graph, frame.gbuffer, hierarchies, numbers, shown, frame.mask(), tracing);
    return {graph.download(rays.radiance), graph.download(rays.direction)};
}

double confidence_of(const DiligentTraced& traced) {
    double sum = 0;
    for (size_t i = 3; i < traced.radiance.values.size(); i += 4) sum += traced.radiance.values[i];
    return sum;
}
