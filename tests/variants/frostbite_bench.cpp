#include "tests/variants/frostbite_bench.h"

#include <bit>

TracedRays upload_rays(PassList& pass_list, const std::vector<StoredRay>& rays) {
    std::vector<glm::vec4> directions;
    std::vector<glm::uvec4> hits;
    for (const StoredRay& ray : rays) {
        directions.emplace_back(ray.direction, ray.inverse_density);
        hits.emplace_back(ray.target, std::bit_cast<unsigned>(ray.length), std::bit_cast<unsigned>(ray.confidence), 0);
    }
    const TracedRays stored{pass_list.buffer("directions", directions.size() * sizeof directions[0]),
                            pass_list.buffer("hits", hits.size() * sizeof hits[0])};
    pass_list.upload(stored.directions, std::as_bytes(std::span(directions)));
    pass_list.upload(stored.hits, std::as_bytes(std::span(hits)));
    return stored;
}

FrostbiteBench::FrostbiteBench(Device& device, const CameraPose& pose, const FrameView& view,
                               const SyntheticScene& scene, const nlohmann::json& parameters)
    : pass_list(device, view.extent),
      camera(camera_data(pose, nullptr, view)),
      gbuffer(upload_gbuffer(pass_list, pose, camera, scene)),
      pose_(pose),
      view_(view),
      scene_(scene) {
    params.assign(parameters);
}

void FrostbiteBench::set_previous(const CameraPose& pose_before, const SyntheticScene& scene_before, glm::vec3 way) {
    FrameView view_before = view_;
    view_before.jitter = view_.previous_jitter;
    const HostGBuffer before = host_gbuffer(pass_list.device(), pose_before, view_before, scene_before);
    gbuffer.previous_depth = pass_list.image("previous_depth", Format::r32f);
    pass_list.upload(gbuffer.previous_depth, before.depth);
    camera = camera_data(pose_, &pose_before, view_);
    pass_list.upload(gbuffer.motion, motion_of(pose_, camera, scene_, way));
}

glm::uvec2 FrostbiteBench::traced_extent() const {
    return ray_parameters.half_resolution ? (pass_list.extent() + 1u) / 2u : pass_list.extent();
}

ResolvedFrame FrostbiteBench::resolve(const std::vector<StoredRay>& rays, const HostImage& color) {
    pass_list.begin_frame(camera, params, gbuffer.images());
    const Image lit = pass_list.image("shown_by_hits", Format::rgba32f);
    pass_list.upload(lit, color);
    return resolve(rays, resolve_parameters.filtered_sampling ? frostbite_color_pyramid(pass_list, lit) : lit);
}

ResolvedFrame FrostbiteBench::resolve(const std::vector<StoredRay>& rays, const Image& color) {
    pass_list.begin_frame(camera, params, gbuffer.images());
    const TracedRays stored = upload_rays(pass_list, rays);
    const FrostbiteResolved resolved = frostbite_resolve(pass_list, gbuffer, color, split_sum_.on(pass_list),
                                                         horizon_.on(pass_list, params), stored, resolve_parameters);
    return {pass_list.download(resolved.radiance), pass_list.download(resolved.reflection_depth)};
}
