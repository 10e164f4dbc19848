#include "variants/common/lit_history.h"
#include "variants/common/variant_entry.h"
#include "variants/frostbite_sssr/horizon_image.h"
#include "variants/resolves/resolves.h"
#include "variants/tracers/tracing_variant.h"

/// Any march and any resolve (variants/resolves), behind Frostbite's draw of directions: what a technique is made of,
/// so that its parts can be compared one by one. Its defaults are a technique of our own.
class ComposedSsr final : public TracingVariant {
public:
    bool depends_on_seed() const override;
    std::string not_repeatable() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers_; }

    RayDrawParameters draw_{params};
    // clang-format off
    Switch draw_directions_{params, "draw_directions", true,
        {"", "draws each ray's direction from the lobe; otherwise it is the mirror's", "ssrlab, to measure the stage"}};
    Choice misses_{params, "misses", "probe", {"weight", "fallback", "probe"},
        {"", "what a ray without a hit contributes. weight: only less confidence; fallback: the environment in its "
         "direction; probe: what the screen says of the surroundings there (variants/common/screen_probe), for scenes "
         "without reflection probes", "ssrlab"}};
    Switch previous_frame_{params, "previous_frame", false,
        {"", "hits take their colour from the previous frame's lit image, where they were then; otherwise from this frame's",
         "ssrlab"}};
    // clang-format on
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

    LitHistory lit_;
    FrostbiteHorizonImage horizon_;
};

Reflections ComposedSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const glm::uvec2 screen = graph.extent(), extent = draw_.half_resolution ? (screen + 1u) / 2u : screen;
    const size_t bytes = size_t(extent.x) * extent.y * draw_.max_rays * 16;
    const ResolvedRays rays{
        .traced = {.directions = graph.buffer("directions", bytes), .hits = graph.buffer("hits", bytes)},
        .color = previous_frame_ ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit,
        .below_horizon = horizon_.on(graph, draw_),
        .draw = draw_,
        .probe = misses_.is("probe") ? std::optional(screen_probe(graph, gbuffer)) : std::nullopt,
        .misses_are_known = !misses_.is("weight"),
        .previous_frame = previous_frame_};
    PassGraph::Pass pass = graph.compute("composed_ssr/trace.comp");
    pass.read(rays.below_horizon).use(rays.traced.directions).use(rays.traced.hits);
    tracers_.run(graph, pass, {"tracer"}, tracers_.images(graph, gbuffer.depth), ray_probe, draw_.max_rays,
                 [&](PassGraph::Pass& tracing) { tracing.run(extent); });
    return resolves_.run(graph, gbuffer, rays, draw_directions_);
}

TracingVariant::Needless ComposedSsr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness", .stages = {"composed_ssr/trace"}};
    const bool answers_rough = misses_.is("probe") && resolves_.chosen().answers_rough_surfaces();
    needless.rays = !facts.has_reflective || (facts.min_roughness > draw_.max_roughness && !answers_rough);
    if (tracers_.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (previous_frame_) needless.stages.insert(needless.stages.begin(), "common/keep_lit");
    if (misses_.is("probe"))
        for (const std::string& stage : screen_probe_stages()) needless.stages.push_back(stage);
    const std::vector<std::string> of_resolve = resolves_.chosen().stages();
    needless.stages.insert(needless.stages.end(), of_resolve.begin(), of_resolve.end());
    const StageReads reads = resolves_.chosen().reads();
    needless.specular_readers = reads.specular;
    needless.specular_readers.insert(needless.specular_readers.begin(), "composed_ssr/trace");
    needless.motion_readers = reads.motion;
    if (previous_frame_ && !std::ranges::count(reads.motion, reads.rays)) needless.motion_readers.push_back(reads.rays);
    if (!misses_.is("weight")) needless.environment_readers = {reads.rays};
    if (misses_.is("probe")) needless.environment_readers.push_back(screen_probe_stages().front());
    return needless;
}

bool ComposedSsr::depends_on_seed() const {
    const bool has_turns = draw_.half_resolution;  // of pixels, in an order of the seed's
    return draw_directions_ || has_turns || tracers_.needs().random || resolves_.chosen().draws_random_numbers();
}

std::string ComposedSsr::not_repeatable() const {
    const std::string of_rays = tracers_.not_repeatable(), of_resolve = resolves_.chosen().not_repeatable();
    return of_rays + (of_rays.empty() || of_resolve.empty() ? "" : "; ") + of_resolve;
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
