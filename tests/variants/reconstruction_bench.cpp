#include "tests/variants/reconstruction_bench.h"

#include "core/scene/camera.h"

ReconstructionBench::ReconstructionBench(Device& device, glm::uvec2 extent, const nlohmann::json& overrides)
    : pass_list(device, extent) {
    parameters.params.assign(overrides);
    parameters.params.assign({{"mask", "depth"}});  // as run() makes it
}

Reconstruction ReconstructionBench::run(const ReconstructionInputs& inputs, const DiligentFilterParameters* targets) {
    const auto upload = [&](const char* name, Format format, const HostImage& pixels) {
        const Image image = pass_list.image_of(name, format, pixels.extent);
        pass_list.upload(image, pixels);
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
    pass_list.begin_frame(inputs.camera, parameters.params, std::array{gbuffer.depth, gbuffer.normal});
    const DiligentResolved resolved =
        diligent_reconstruct(pass_list, gbuffer, rays, mask, targets ? *targets : parameters.filter);
    return {.radiance = pass_list.download(resolved.radiance),
            .variance = pass_list.download(resolved.variance),
            .hit_depth = pass_list.download(resolved.hit_depth)};
}

ReconstructionInputs reflecting_wall(const ReflectingWall& wall) {
    const CameraPose pose{.is_orthographic = wall.is_orthographic, .vertical_fov = glm::radians(60.0f)};
    const CameraData camera = camera_data(pose, nullptr, {.extent = wall.extent, .jitter = wall.jitter});
    const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -wall.distance, 1);
    ReconstructionInputs inputs{.camera = camera,
                                .depth = HostImage(wall.extent, 1, clip.z / clip.w),
                                .normal = HostImage(wall.extent, 4),
                                .mask = HostImage(wall.extent, 1, 1.0f),
                                .roughness = HostImage(wall.extent, 1, wall.roughness),
                                .ray_radiance = HostImage(wall.ray_extent, 4),
                                .ray_direction = HostImage(wall.ray_extent, 4)};
    for (size_t i = 0; i < inputs.normal.pixel_count(); ++i) inputs.normal.set_rgb(i, {0, 0, 1});
    for (unsigned y = 0; y < wall.ray_extent.y; ++y)
        for (unsigned x = 0; x < wall.ray_extent.x; ++x) {
            const TexelRay ray = wall.ray(x, y);
            const size_t i = size_t(y) * wall.ray_extent.x + x;
            inputs.ray_radiance.set_rgb(i, ray.radiance);
            inputs.ray_radiance.values[4 * i + 3] = ray.confidence;
            inputs.ray_direction.set_rgb(i, ray.direction);
            inputs.ray_direction.values[4 * i + 3] = ray.density;
        }
    return inputs;
}
