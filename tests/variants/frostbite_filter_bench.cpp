#include "tests/variants/frostbite_filter_bench.h"

FrostbiteFilterBench::FrostbiteFilterBench(Device& device, const FrameView& view, const nlohmann::json& overrides)
    : view(view), pass_list(device, view.extent) {
    parameters.params.assign(overrides);
}

GBuffer FrostbiteFilterBench::upload(const CameraPose& pose, const SyntheticScene& scene) {
    camera_ = camera_data(pose, view.frame > 0 ? &pose_before_ : nullptr, view);
    GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera_, scene);
    const HostImage depth = pass_list.download(gbuffer.depth), normal = pass_list.download(gbuffer.normal);
    if (view.frame > 0) {
        gbuffer.previous_depth = pass_list.image("previous_depth", Format::r32f);
        gbuffer.previous_normal = pass_list.image("previous_normal", Format::rgba32f);
        pass_list.upload(gbuffer.previous_depth, depth_before_);
        pass_list.upload(gbuffer.previous_normal, normal_before_);
        pass_list.upload(gbuffer.motion, motion_of(pose, camera_, scene));
    }
    pose_before_ = pose;
    depth_before_ = depth;
    normal_before_ = normal;
    return gbuffer;
}

HostImage FrostbiteFilterBench::next(
    const CameraPose& pose, const SyntheticScene& scene,
    const std::function<ResolvedPixel(glm::uvec2 pixel, const CameraRay& ray)>& resolved) {
    const GBuffer gbuffer = upload(pose, scene);
    HostImage radiance(view.extent, 4), ray_length(view.extent, 1);
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) {
            const ResolvedPixel pixel =
                resolved({x, y}, camera_ray(pose, view.extent, glm::vec2(x, y) + 0.5f + view.jitter));
            for (int i = 0; i < 3; ++i) radiance.pixel(x, y)[i] = pixel.radiance[i];
            radiance.pixel(x, y)[3] = pixel.confidence;
            *ray_length.pixel(x, y) = pixel.ray_length;
        }
    const FrostbiteResolved images{pass_list.image("resolved_radiance", Format::rgba32f),
                                   pass_list.image("resolved_length", Format::r32f)};
    pass_list.upload(images.radiance, radiance);
    pass_list.upload(images.reflection_depth, ray_length);
    pass_list.begin_frame(camera_, parameters.params, gbuffer.images());
    const Image reflections =
        frostbite_accumulate(pass_list, gbuffer, split_sum_.on(pass_list), images, parameters.resolve);
    ++view.frame;
    view.previous_jitter = view.jitter;
    return pass_list.download(reflections);
}
