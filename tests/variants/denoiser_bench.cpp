#include "tests/variants/denoiser_bench.h"

#include "variants/denoisers/denoisers.h"
#include "variants/denoisers/first_turn.h"

DenoiserBench::DenoiserBench(Device& device, const std::string& denoiser, const CameraPose& pose, glm::uvec2 extent,
                             SyntheticScene scene, const nlohmann::json& own, const nlohmann::json& of_technique)
    : pose(pose),
      pass_list(device, extent),
      scene_(std::move(scene)),
      denoiser_(std::make_unique<Denoiser>(find_denoiser(denoiser))) {
    add_block(technique_, "denoisers/rays.json");
    technique_.assign({{"misses", "weight"}});
    technique_.assign({{"half_resolution", false}, {"max_roughness", 1}});
    technique_.assign(of_technique);
    denoiser_->params.assign(own);
}

/// As traced_pixel.glsl says of the seed 0.
std::vector<glm::uvec2> DenoiserBench::traced_pixels() const {
    const unsigned side = value_of(technique_, "half_resolution") == true ? 2 : 1, turn = frame_ + first_turn(0);
    const glm::uvec2 of_quad = side == 1 ? glm::uvec2(0) : glm::uvec2((turn ^ turn >> 1) & 1, turn & 1);
    std::vector<glm::uvec2> pixels;
    for (unsigned y = 0; y < pass_list.extent().y; y += side)
        for (unsigned x = 0; x < pass_list.extent().x; x += side)
            pixels.push_back(glm::min(glm::uvec2(x, y) + of_quad, pass_list.extent() - 1u));
    return pixels;
}

/// In images of their own; in the first frame its own.
void DenoiserBench::keep_previous(GBuffer& gbuffer) {
    const auto keep = [&](Image& input, const char* name, const Image& current, HostImage& before) {
        const HostImage now = pass_list.download(current);
        input = pass_list.image(std::string("kept_") + name, current.format).as(name);
        pass_list.upload(input, frame_ > 0 ? before : now);
        before = now;
    };
    keep(gbuffer.previous_depth, "previous_depth", gbuffer.depth, depth_before_);
    keep(gbuffer.previous_normal, "previous_normal", gbuffer.normal, normal_before_);
}

HostImage DenoiserBench::next(const RayFrame& frame) {
    const glm::uvec2 extent = pass_list.extent();
    const FrameView view{.extent = extent, .frame = frame_};
    const CameraData camera = camera_data(pose, frame_ > 0 ? &pose_before_ : nullptr, view);
    GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene_);
    keep_previous(gbuffer);
    pass_list.upload(gbuffer.fallback, HostImage(extent, 4, environment));
    const bool has_moved = frame_ > 0 && pose.world_from_view != pose_before_.world_from_view;
    HostImage color(extent, 4, 1), motion = has_moved ? motion_of(pose, camera, scene_) : HostImage(extent, 2);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            color.set_rgb(size_t(y) * extent.x + x, frame.color({x, y}));
            for (int c = 0; c < 2; ++c) motion.pixel(x, y)[c] += frame.motion({x, y})[c];
        }
    pass_list.upload(gbuffer.motion, motion);
    std::vector<StoredRay> rays;
    for (const glm::uvec2 pixel : traced_pixels()) {
        const CameraRay seen = camera_ray(pose, extent, glm::vec2(pixel) + 0.5f);
        const glm::vec3 mirrored = reflect(seen.direction, scene_(seen).normal);
        rays.push_back({.direction = transpose(glm::mat3(pose.world_from_view)) * mirrored,
                        .inverse_density = 1,
                        .target = packed(pixel),
                        .length = 1});
        frame.change(pixel, rays.back());
    }
    pass_list.begin_frame(camera, technique_, gbuffer.images());
    if (value_of(technique_, "misses") == "probe") probe = screen_probe(pass_list, gbuffer);
    const DenoisedRays resolved{.technique = technique_,
                                .traced = upload_rays(pass_list, rays),
                                .color = pass_list.image("shown_by_hits", Format::rgba32f),
                                .probe = probe};
    pass_list.upload(resolved.color, color);
    const HostImage radiance = pass_list.download(denoiser_->run(pass_list, gbuffer, resolved).radiance);
    pass_list.set_params(technique_);
    ++frame_;
    pose_before_ = pose;
    return radiance;
}
