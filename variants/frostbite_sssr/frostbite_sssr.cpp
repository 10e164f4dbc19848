#include "variants/frostbite_sssr/frostbite_sssr.h"

#include "variants/common/lit_history.h"
#include "variants/frostbite_sssr/passes.h"

Reflections FrostbiteSssr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    constexpr unsigned alpha = 3;
    if (is_left_out_) {
        const Image nothing = graph.image("reflections", Format::rgba32f);
        graph.clear(nothing, {});
        return {nothing, nothing, alpha};
    }
    const Tracers::Images traced_images = ray_.tracers.images(graph, gbuffer.depth);
    const Image color = resolve_.previous_frame ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit;
    const Image filtered = resolve_.filtered_sampling ? frostbite_color_pyramid(graph, color) : color;
    const FrostbiteTiles tiles = frostbite_classify(graph, gbuffer, traced_images, color, ray_, ray_probe);
    const FrostbiteWork work = frostbite_allocate(graph, gbuffer, tiles, ray_);
    const Image below_horizon = horizon_.on(graph, ray_);
    const FrostbiteRays rays = frostbite_trace(graph, traced_images, work, below_horizon, ray_, ray_probe);
    const Image split_sum = split_sum_.on(graph);
    const FrostbiteResolved resolved =
        frostbite_resolve(graph, gbuffer, filtered, split_sum, below_horizon, rays, resolve_);
    const Image reflections = frostbite_accumulate(graph, gbuffer, split_sum, resolved, resolve_);
    return {reflections, reflections, alpha};
}

std::vector<LeftOut> FrostbiteSssr::leave_out_passes(const SceneFacts& facts) {
    is_left_out_ = !facts.has_reflective || facts.min_roughness > ray_.max_roughness;
    if (!is_left_out_) return {};
    std::vector<std::string> stages = {"frostbite_sssr/allocate", "frostbite_sssr/trace_smooth",
                                       "frostbite_sssr/trace_rough", "frostbite_sssr/resolve"};
    if (ray_.tracers.needs_pyramid()) stages.insert(stages.begin(), "common/depth_pyramid");
    if (resolve_.previous_frame) stages.push_back("common/keep_lit");
    if (resolve_.filtered_sampling) stages.push_back("frostbite_sssr/color_pyramid");
    if (ray_.classification) stages.push_back("frostbite_sssr/classify");
    if (resolve_.temporal_filter || !resolve_.reflectance_after_filter) stages.push_back("frostbite_sssr/accumulate");
    return left_out_without_rays(facts, "as smooth as max_roughness", stages);
}
