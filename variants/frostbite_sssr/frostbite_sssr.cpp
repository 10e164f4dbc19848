#include "variants/frostbite_sssr/frostbite_sssr.h"

#include "variants/common/lit_history.h"
#include "variants/frostbite_sssr/passes.h"

#include <algorithm>

Reflections FrostbiteSssr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    constexpr unsigned alpha = 3;
    if (is_left_out_) {
        const Image nothing = graph.image("reflections", Format::rgba32f);
        graph.clear(nothing, {});
        return {nothing, nothing, alpha};
    }
    const Tracers::Images traced_images = ray_.tracers.images(graph, gbuffer.depth);
    const Image color = resolve_.previous_frame ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit;
    const Image filtered = resolve_.filtered_sampling && filters_color_ ? frostbite_color_pyramid(graph, color) : color;
    const FrostbiteTiles tiles = frostbite_classify(graph, gbuffer, traced_images, color, ray_, ray_probe);
    FrostbiteWork work = frostbite_allocate(graph, gbuffer, tiles, ray_);
    work.has_smooth = has_smooth_rays_, work.has_rough = has_rough_rays_;
    const Image below_horizon = horizon_.on(graph, ray_);
    const FrostbiteRays rays = frostbite_trace(graph, traced_images, work, below_horizon, ray_, ray_probe);
    const Image split_sum = split_sum_.on(graph);
    const FrostbiteResolved resolved =
        frostbite_resolve(graph, gbuffer, filtered, split_sum, below_horizon, rays, resolve_);
    const Image reflections = frostbite_accumulate(graph, gbuffer, split_sum, resolved, resolve_);
    return {reflections, reflections, alpha};
}

TracingVariant::Needless FrostbiteSssr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness",
                      .stages = {"frostbite_sssr/allocate", "frostbite_sssr/trace_smooth", "frostbite_sssr/trace_rough",
                                 "frostbite_sssr/resolve"}};
    needless.rays = is_left_out_ = !facts.has_reflective || facts.min_roughness > ray_.max_roughness;
    const bool has_accumulation = resolve_.temporal_filter || !resolve_.reflectance_after_filter;
    if (ray_.tracers.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (resolve_.previous_frame) needless.stages.push_back("common/keep_lit");
    if (resolve_.filtered_sampling) needless.stages.push_back("frostbite_sssr/color_pyramid");
    if (ray_.classification) needless.stages.push_back("frostbite_sssr/classify");
    if (has_accumulation) needless.stages.push_back("frostbite_sssr/accumulate");

    has_smooth_rays_ = facts.min_roughness < ray_.rough_from;
    has_rough_rays_ = std::min(facts.max_roughness, float(ray_.max_roughness)) >= ray_.rough_from;
    if (!has_smooth_rays_)
        needless.parts.push_back(
            {"frostbite_sssr/trace_smooth", "no reflective surface below rough_from", "its list is empty"});
    if (!has_rough_rays_)
        needless.parts.push_back(
            {"frostbite_sssr/trace_rough", "no reflective surface from rough_from on", "its list is empty"});
    filters_color_ = resolve_.filtered_sampling && facts.max_roughness > 0;
    if (resolve_.filtered_sampling && !filters_color_) {
        needless.parts.push_back(
            {"frostbite_sssr/color_pyramid", "all that reflects is a mirror", "cones of mirrors have no width"});
        needless.constants["filtered_sampling"] = false;
    }
    if (has_accumulation && resolve_.temporal_filter) needless.motion_readers = {"frostbite_sssr/accumulate"};
    if (resolve_.previous_frame) {
        needless.motion_readers.push_back("frostbite_sssr/resolve");
        if (ray_.classification) needless.motion_readers.push_back("frostbite_sssr/classify");
    }
    if (resolve_.misses.is("fallback")) needless.environment_readers = {"frostbite_sssr/resolve"};
    return needless;
}
