#include "tests/variants/reconstruction_bench.h"

ReconstructionBench::ReconstructionBench(Device& device, glm::uvec2 extent, const nlohmann::json& overrides)
    : graph(device, extent) {
    parameters.params.assign(overrides);
}

Reconstruction ReconstructionBench::run(const ReconstructionInputs& inputs) {
    const auto upload = [&](const char* name, Format format, const HostImage& pixels) {
        const Image image = graph.image_of(name, format, pixels.extent);
        graph.upload(image, pixels);
        return image;
    };
    GBuffer gbuffer;
    gbuffer.depth = upload("depth", Format::r32f, inputs.depth);
    gbuffer.normal = upload("normal", Format::rgba32f, inputs.normal);
    const Format ray_format = parameters.tracing.float_rays ? Format::rgba32f : Format::rgba16f;
    const DiligentRays rays{.radiance = upload("ray_radiance", ray_format, inputs.ray_radiance),
                            .direction = upload("ray_direction", ray_format, inputs.ray_direction)};
    const Image kept = upload("mask", Format::d16, inputs.mask);
    const DiligentMask mask{
        .roughness = upload("roughness", Format::r32f, inputs.roughness), .full = kept, .traced = kept};
    graph.begin_frame(inputs.camera, parameters.params, std::array{gbuffer.depth, gbuffer.normal});
    const DiligentResolved resolved = diligent_reconstruct(graph, gbuffer, rays, mask, parameters.filter);
    return {.radiance = graph.download(resolved.radiance),
            .variance = graph.download(resolved.variance),
            .hit_depth = graph.download(resolved.hit_depth)};
}
