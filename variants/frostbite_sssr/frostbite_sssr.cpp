#include "core/gbuffer/split_sum_image.h"
#include "variants/common/lit_history.h"
#include "variants/common/variant_entry.h"
#include "variants/frostbite_sssr/horizon_image.h"
#include "variants/frostbite_sssr/passes.h"
#include "variants/frostbite_sssr/ray_parameters.h"
#include "variants/frostbite_sssr/resolve_parameters.h"
#include "variants/tracers/tracing_variant.h"

#include <algorithm>

/// Stochastic screen-space reflections as Frostbite's authors presented them: Stachowiak and Uludag 2015, "Stochastic
/// Screen-Space Reflections", SIGGRAPH course Advances in Real-Time Rendering. Much of it was never published;
/// README.md says what is theirs and what is ours.
class FrostbiteSssr final : public TracingVariant {
private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return ray_.tracers; }

    FrostbiteRayParameters ray_{params};
    FrostbiteResolveParameters resolve_{params};
    LitHistory lit_;
    SplitSumImage split_sum_;
    FrostbiteHorizonImage horizon_;
    bool has_smooth_rays_ = true, has_rough_rays_ = true, filters_color_ = true;  // until leave_out()
};

Reflections FrostbiteSssr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Tracers::Images traced_images = ray_.tracers.images(graph, gbuffer.depth);
    const Image color = resolve_.previous_frame ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit;
    const Image filtered = resolve_.filtered_sampling && filters_color_ ? frostbite_color_pyramid(graph, color) : color;
    const FrostbiteTiles tiles = frostbite_classify(graph, gbuffer, traced_images, color, ray_, ray_probe);
    FrostbiteWork work = frostbite_allocate(graph, gbuffer, tiles, ray_);
    work.has_smooth = has_smooth_rays_, work.has_rough = has_rough_rays_;
    const Image below_horizon = horizon_.on(graph, ray_);
    const TracedRays rays = frostbite_trace(graph, traced_images, work, below_horizon, ray_, ray_probe);
    const Image split_sum = split_sum_.on(graph);
    const FrostbiteResolved resolved =
        frostbite_resolve(graph, gbuffer, filtered, split_sum, below_horizon, rays, resolve_);
    const Image reflections = frostbite_accumulate(graph, gbuffer, split_sum, resolved, resolve_);
    return {reflections, reflections, 3};
}

TracingVariant::Needless FrostbiteSssr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness",
                      .stages = {"frostbite_sssr/allocate", "frostbite_sssr/trace_smooth", "frostbite_sssr/trace_rough",
                                 "frostbite_sssr/resolve"}};
    needless.rays = !facts.has_reflective || facts.min_roughness > ray_.max_roughness;
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
    needless.specular_readers = {"frostbite_sssr/allocate"};
    if (ray_.classification) needless.specular_readers.push_back("frostbite_sssr/classify");
    if (has_accumulation && resolve_.temporal_filter) needless.motion_readers = {"frostbite_sssr/accumulate"};
    if (resolve_.previous_frame) {
        needless.motion_readers.push_back("frostbite_sssr/resolve");
        if (ray_.classification) needless.motion_readers.push_back("frostbite_sssr/classify");
    }
    if (resolve_.misses.is("fallback")) needless.environment_readers = {"frostbite_sssr/resolve"};
    return needless;
}

VariantEntry frostbite_sssr_entry() {
    return {
        .name = "frostbite_sssr",
        .title = "Frostbite's stochastic screen-space reflections, with ray reuse",
        .source =
            "Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, SIGGRAPH course Advances in Real-Time "
            "Rendering, as quoted by others; gaps are filled by ssrlab",
        .description =
            "Probes decide how many rays each tile gets; a hierarchical march serves smooth surfaces and linear steps "
            "rough ones; each pixel weighs its neighbours' rays by its own BRDF, takes their colours from mip levels, "
            "and blends with its reflection of the previous frame.",
        .presets =
            {{"frostbite_2015",
              "the configuration whose times were published: 1 ray per half-resolution pixel, 4 taps, 0.7 of the "
              "lobe cut off, estimator a; where nothing was published, our defaults",
              nlohmann::json::object()},
             {"one_ray_one_tap",
              "the same without reuse: each pixel shows its own half-resolution pixel's ray (not published)",
              {{"taps", "1"}}},
             {"four_rays_one_tap",
              "the published comparison, which takes twice as long and looks worse: 4 rays per half-resolution "
              "pixel in place of reuse",
              {{"min_rays", 4}, {"max_rays", 4}, {"taps", "1"}}},
             {"best",
              "the least error that a search before `ssrlab tune` found (commit 5cf9fef): one ray per pixel from "
              "0.7 of the "
              "lobe of visible normals; hits that the previous frame did not show use the environment",
              {{"half_resolution", false},
               {"lobe", "visible_normals"},
               {"importance_bias", 0.3},
               {"frostbite.relative_thickness", 0.02},
               {"hidden_hits", "miss"},
               {"cone_scale", 0.5},
               {"pattern", "interleaved"},
               {"clamp_scale", 1.0},
               {"repair_inputs", true}}}},
        .create = [] { return std::make_unique<FrostbiteSssr>(); },
    };
}
