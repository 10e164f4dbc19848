#include "variants/common/variant_entry.h"
#include "variants/resolves/ray_inputs.h"

/// Any march and any resolve (variants/resolves), behind Frostbite's draw of directions: what a technique is made of,
/// so that its parts can be compared one by one. Its defaults are a technique of our own.
class ComposedSsr final : public TracingVariant {
public:
    bool depends_on_seed() const override { return rays_.depends_on_seed(resolves_) || tracers_.needs().random; }
    std::string not_repeatable() const override { return rays_.not_repeatable(tracers_, resolves_); }

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers_; }

    RayInputs rays_{params};
    Tracers tracers_{params,
                     {{"tracer", "trace", "dda", "the march that finds what a ray meets"}},
                     "ssrlab",
                     {{"lobe", "visible_normals"},
                      {"importance_bias", 0.1},
                      {"dda.relative_thickness", 0.02},
                      {"dda.thickness", 0.0},
                      {"cells.relative_thickness", 0.01},
                      {"cells.thickness", 0.0}}};
    mutable Resolves resolves_{params, "ratio_accumulation"};
};

Reflections ComposedSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const ResolvedRays rays = rays_.make(graph, gbuffer);
    PassGraph::Pass pass = graph.compute("composed_ssr/trace.comp");
    pass.read(rays.below_horizon).use(rays.traced.directions).use(rays.traced.hits);
    tracers_.run(graph, pass, {"tracer"}, tracers_.images(graph, gbuffer.depth), ray_probe, rays_.max_rays(),
                 [&](PassGraph::Pass& tracing) { tracing.run(rays_.traced_extent(graph.extent())); });
    return rays_.show(graph, gbuffer, rays, resolves_);
}

TracingVariant::Needless ComposedSsr::find_needless(const SceneFacts& facts) {
    Needless needless{.stages = {"composed_ssr/trace"}, .specular_readers = {"composed_ssr/trace"}};
    if (tracers_.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    rays_.add_needless(needless, facts, resolves_);
    return needless;
}

namespace {

/// What the resolves are compared behind: a ray for every pixel, and nothing in place of misses.
const nlohmann::json compared_behind = {
    {"repair_inputs", true},  {"tracer", "cells"},    {"misses", "weight"},           {"half_resolution", false},
    {"importance_bias", 0.3}, {"dda.thickness", 0.1}, {"dda.relative_thickness", 0.0}};

/// A resolve of the same name, with faulty inputs repaired.
Preset preset_of(const std::string& resolve, const std::string& meaning, const nlohmann::json& of_resolve) {
    nlohmann::json parameters = changed(compared_behind, {{"resolve", resolve}});
    for (const auto& [name, value] : of_resolve.items()) parameters[resolve + "." + name] = value;
    return {resolve, meaning, parameters};
}

const nlohmann::json amd_values = {{"average_pull", 0.1223},
                                   {"barrier_before_average", true},
                                   {"clip_scale", 2.643},
                                   {"current_sample_count", true},
                                   {"finite_neighborhood", true},
                                   {"float_histories", true},
                                   {"fresh_neighborhood", true},
                                   {"guard_previous_clip", true},
                                   {"no_dark_exit", true},
                                   {"prefilter", false},
                                   {"reproject_history_depth", true},
                                   {"round_up_tiles", true},
                                   {"running_variance", true},
                                   {"surface_discard_variance_weight", 1.216},
                                   {"temporal_stability_factor", 0.358}};

const nlohmann::json diligent_values = {{"axial_hit_depth", true},
                                        {"bilateral_cleanup", false},
                                        {"centered_search", true},
                                        {"finite_weights", true},
                                        {"float_histories", true},
                                        {"guard_previous_clip", true},
                                        {"linear_hit_depth", true},
                                        {"spatial_reconstruction_radius", 1.054},
                                        {"temporal_radiance_stability_factor", 0.8198},
                                        {"temporal_variance_stability_factor", 0.726}};

const nlohmann::json frostbite_values = {{"clamp_scale", 5.017},     {"filtered_sampling", false},
                                         {"history_weight", 0.7855}, {"neighbor_ray", "direction"},
                                         {"pattern", "interleaved"}, {"reflection_depth", "max"}};

const nlohmann::json recurrent_values = {
    {"scale_free", true}, {"reproject_misses", true}, {"flicker_suppression", 0}, {"damp_fireflies", false}};

const nlohmann::json ratio_values = {
    {"averages", "linear"}, {"bilateral_filter", false}, {"neighbor_ray", "direction"}, {"sharp_mirrors", true}};

const nlohmann::json speed_values = {{"average_confidence", true}, {"average_evenly", true},
                                     {"misses_stand_still", true}, {"depth_of_target", true},
                                     {"reproject_history", true},  {"local_frame", true}};

const nlohmann::json cone_values = {{"square_lengths", true},  {"lobe_cone", true},      {"even_weights", true},
                                    {"tone_map_colors", true}, {"average_linear", true}, {"exact_upsampling", true},
                                    {"fade_begin", 1.0}};

/// Behind the mirror rays that it is made for.
Preset cone_mips_preset() {
    Preset preset = preset_of(
        "cone_mips", "mirror rays; Godot's values with its defects fixed, and no fade by roughness", cone_values);
    preset.parameters["draw_directions"] = false;
    return preset;
}

}  // namespace

VariantEntry composed_ssr_entry() {
    return {
        .name = "composed_ssr",
        .title = "Any march and any resolve, behind one draw of directions; by default a technique of our own",
        .source = "ssrlab; the draw is that of Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections",
        .description =
            "Rays are drawn from the lobe, marched by the chosen tracer and made a picture of by the chosen resolve; "
            "both "
            "have the parameters that they have elsewhere. By default one pixel in four starts a ray, all frames since "
            "the pixel's reflection came into sight are one ratio estimator, and what the screen does not show is "
            "guessed from what it does, for rough surfaces without a ray.",
        .presets = {{"repaired", "the defaults, with faulty inputs repaired", {{"repair_inputs", true}}},
                    preset_of("mean", "the pixel's own ray", {}),
                    preset_of("blur", "a blur of one size", {{"blur_width", 0.04}}),
                    preset_of("amd_denoiser", "with the values of amd_sssr's best_1x", amd_values),
                    preset_of("diligent_filters", "with the values of diligent_ssr's best_2x", diligent_values),
                    preset_of("frostbite_reuse", "with the values of frostbite_sssr's best_2x", frostbite_values),
                    preset_of("recurrent_blur",
                              "three.js's values, with lengths and colours in proportion, misses reprojected, and "
                              "nothing that darkens",
                              recurrent_values),
                    preset_of("ratio_filter",
                              "EEVEE's values with linear averages, neighbours' rays in their own direction, sharp "
                              "mirrors, and no bilateral filter",
                              ratio_values),
                    preset_of("speed_accumulation", "HDRP's values, with its defects fixed", speed_values),
                    cone_mips_preset(),
                    preset_of("ratio_accumulation", "the defaults' resolve behind the march and the draw of the others",
                              {}),
                    preset_of("reservoirs", "kajiya's values, as far as they have a place here", {})},
        .create = [] { return std::make_unique<ComposedSsr>(); },
    };
}
