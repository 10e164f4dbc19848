#include "tests/variants/frostbite_bench.h"

#include <bit>

TracedRays upload_rays(PassGraph& graph, const std::vector<StoredRay>& rays) {
    std::vector<glm::vec4> directions;
    std::vector<glm::uvec4> hits;
    for (const StoredRay& ray : rays) {
        directions.emplace_back(ray.direction, ray.inverse_density);
        hits.emplace_back(ray.target, std::bit_cast<unsigned>(ray.length), std::bit_cast<unsigned>(ray.confidence), 0);
    }
    const TracedRays stored{graph.buffer("directions", directions.size() * sizeof directions[0]),
                            graph.buffer("hits", hits.size() * sizeof hits[0])};
    graph.upload(stored.directions, std::as_bytes(std::span(directions)));
    graph.upload(stored.hits, std::as_bytes(std::span(hits)));
    return stored;
}

FrostbiteBench::FrostbiteBench(Device& device, const CameraPose& pose, const FrameView& view,
                               const SyntheticScene& scene, const nlohmann::json& parameters)
    : graph(device, view.extent),
      camera(camera_data(pose, nullptr, view)),
      gbuffer(upload_gbuffer(graph, pose, camera, scene)),
      pose_(pose),
      view_(view),
      scene_(scene) {
    params.assign(parameters);
}

void FrostbiteBench::set_previous(const CameraPose& pose_before, const SyntheticScene& scene_before, glm::vec3 way) {
    FrameView view_before = view_;
    view_before.jitter = view_.previous_jitter;
    const HostGBuffer before = host_gbuffer(graph.device(), pose_before, view_before, scene_before);
    gbuffer.previous_depth = graph.image("previous_depth", Format::r32f);
    graph.upload(gbuffer.previous_depth, before.depth);
    camera = camera_data(pose_, &pose_before, view_);
    graph.upload(gbuffer.motion, motion_of(pose_, camera, scene_, way));
}

glm::uvec2 FrostbiteBench::traced_extent() const {
    return ray_parameters.half_resolution ? (graph.extent() + 1u) / 2u : graph.extent();
}

ResolvedFrame FrostbiteBench::resolve(const std::vector<StoredRay>& rays, const HostImage& color) {
    graph.begin_frame(camera, params, gbuffer.images());
    const Image lit = graph.image("shown_by_hits", Format::rgba32f);
    graph.upload(lit, color);
    return resolve(rays, resolve_parameters.filtered_sampling ? frostbite_color_pyramid(graph, lit) : lit);
}

ResolvedFrame FrostbiteBench::resolve(const std::vector<StoredRay>& rays, const Image& color) {
    graph.begin_frame(camera, params, gbuffer.images());
    const TracedRays stored = upload_rays(graph, rays);
    const FrostbiteResolved resolved = frostbite_resolve(graph, gbuffer, color, split_sum_.on(graph),
                                                         horizon_.on(graph, params), stored, resolve_parameters);
    return {graph.download(resolved.radiance), graph.download(resolved.reflection_depth)};
}
