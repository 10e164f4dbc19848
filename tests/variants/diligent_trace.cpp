#include "tests/variants/diligent_trace.h"

#include "tests/variants/diligent_frames.h"

DiligentTraced diligent_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                                    const HostImage& noise, const HostImage* color) {
    DiligentFrames frame(device, gbuffer.extent(), parameters);
    frame.begin(gbuffer);
    PassList& pass_list = frame.pass_list;
    const DiligentTracingParameters& tracing = frame.parameters.tracing;
    const Image numbers = pass_list.image_of("blue_noise", Format::rg32f, noise.extent);
    pass_list.upload(numbers, noise);
    Image shown = frame.gbuffer.lit;
    if (color) {
        shown = pass_list.image("color", Format::rgba32f);
        pass_list.upload(shown, *color);
    }
    const Tracers::Images hierarchies = diligent_depth_hierarchies(pass_list, frame.gbuffer, tracing);
    const DiligentRays rays =
        diligent_trace(pass_list, frame.gbuffer, hierarchies, numbers, shown, frame.mask(), tracing);
    return {pass_list.download(rays.radiance), pass_list.download(rays.direction)};
}

double confidence_of(const DiligentTraced& traced) {
    double sum = 0;
    for (size_t i = 3; i < traced.radiance.values.size(); i += 4) sum += traced.radiance.values[i];
    return sum;
}
