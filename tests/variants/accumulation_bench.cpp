#include "tests/variants/accumulation_bench.h"

AccumulationBench::AccumulationBench(Device& device, glm::uvec2 extent, const nlohmann::json& overrides)
    : pass_list(device, extent) {
    parameters.params.assign(overrides);
    parameters.params.assign({{"mask", "depth"}});  // as upload_mask() makes it
}

Image AccumulationBench::upload(const std::string& name, Format format, const HostImage& pixels) {
    const Image image = pass_list.image_of(name, format, pixels.extent);
    pass_list.upload(image, pixels);
    return image;
}

DiligentMask AccumulationBench::upload_mask(const HostImage& kept, const HostImage& roughness) {
    const Image full = upload("mask", Format::d16, kept);
    return {.roughness = upload("roughness", Format::r32f, roughness), .full = full, .traced = full};
}

Filtered AccumulationBench::accumulate(const AccumulationInputs& inputs) {
    GBuffer gbuffer;
    gbuffer.motion = upload("motion", Format::rg32f, inputs.motion);
    gbuffer.previous_depth = upload("previous_depth", Format::r32f, inputs.previous_depth);
    const Image reprojected_depth = upload("reprojected_depth", Format::r32f, inputs.reprojected_depth);
    const DiligentResolved resolved{
        .radiance = upload("resolved_radiance", colors(), inputs.resolved.radiance),
        .variance = upload("resolved_variance", numbers(), inputs.resolved.variance),
        .hit_depth =
            upload("hit_depth", parameters.filter.linear_hit_depth ? Format::r32f : Format::r16f, inputs.hit_depth)};
    const DiligentMask mask = upload_mask(inputs.mask, HostImage(inputs.mask.extent, 1));
    pass_list.begin_frame(inputs.camera, parameters.params, std::array{gbuffer.motion, gbuffer.previous_depth});
    const DiligentHistories histories = diligent_histories(pass_list, parameters.filter);
    pass_list.upload(histories.radiance.previous, inputs.history.radiance);
    pass_list.upload(histories.variance.previous, inputs.history.variance);
    diligent_accumulate(pass_list, gbuffer, reprojected_depth, resolved, histories, mask, parameters.filter);
    return {.radiance = pass_list.download(histories.radiance.current),
            .variance = pass_list.download(histories.variance.current)};
}

HostImage AccumulationBench::clean_up(const CleanupInputs& inputs) {
    GBuffer gbuffer;
    gbuffer.depth = upload("depth", Format::r32f, inputs.depth);
    gbuffer.normal = upload("normal", Format::rgba32f, inputs.normal);
    const Image radiance = upload("radiance", colors(), inputs.accumulated.radiance);
    const Image variance = upload("variance", numbers(), inputs.accumulated.variance);
    const DiligentMask mask = upload_mask(inputs.mask, inputs.roughness);
    pass_list.begin_frame(inputs.camera, parameters.params, std::array{gbuffer.depth, gbuffer.normal});
    return pass_list.download(diligent_cleanup(pass_list, gbuffer, radiance, variance, mask, parameters.filter));
}
