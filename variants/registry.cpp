#include "variants/registry.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/amd_sssr/amd_sssr.h"
#include "variants/diligent_ssr/diligent_ssr.h"
#include "variants/frostbite_sssr/frostbite_sssr.h"
#include "variants/mcguire_dda/mcguire_dda.h"
#include "variants/none/none.h"

namespace {

template <class T>
std::unique_ptr<Variant> create() {
    return std::make_unique<T>();
}

nlohmann::json with(nlohmann::json parameters, const nlohmann::json& more) {
    parameters.update(more);
    return parameters;
}

const nlohmann::json amd_corrected = {{"hierarchy.min_traversal_occupancy", 0},     {"hierarchy.thickness_at_hit_mip", true},
                                      {"independent_noise_shifts", true}, {"trace_orphans", true},
                                      {"hierarchy.clip_ray_to_near_plane", true},   {"hierarchy.zero_direction", "nudged"},
                                      {"guard_mirror_normal", true},      {"redraw_below_horizon", true},
                                      {"inward_rays", "black"},           {"hierarchy.stop_outside_screen", true},
                                      {"hierarchy.partial_texels", "near_plane"},    {"hierarchy.reject_unfinished", true},
                                      {"rate_stored_roughness", true},    {"barrier_before_average", true},
                                      {"current_sample_count", true},     {"no_dark_exit", true},
                                      {"running_variance", true},         {"round_up_tiles", true},
                                      {"reproject_history_depth", true},  {"guard_previous_clip", true},
                                      {"finite_neighborhood", true},      {"fresh_neighborhood", true},
                                      {"float_histories", true}};

const nlohmann::json diligent_corrected = {{"temporal_radiance_stability_factor", 0.9},
                                           {"hierarchy.partial_texels", "clamped"},
                                           {"hierarchy.unproject_jitter", true},
                                           {"bias_towards_mirror", true},
                                           {"hierarchy.clip_ray_to_near_plane", true},
                                           {"hierarchy.relative_ray_step", true},
                                           {"inward_rays", "missed"},
                                           {"hierarchy.stop_outside_screen", true},
                                           {"hierarchy.reject_unfinished", true},
                                           {"independent_noise_shifts", true},
                                           {"float_rays", true},
                                           {"premultiply_confidence", true},
                                           {"nearest_half_rays", true},
                                           {"axial_hit_depth", true},
                                           {"linear_hit_depth", true},
                                           {"centered_search", true},
                                           {"guard_previous_clip", true},
                                           {"finite_weights", true},
                                           {"float_histories", true}};

const std::vector<VariantEntry> table = {
    {
        .name = "none",
        .title = "No screen-space reflections",
        .source = "ssrlab",
        .description = "Confidence 0 everywhere: the fallback alone, against which every technique is read.",
        .needs = {},
        .presets = {},
        .create = create<None>,
    },
    {
        .name = "mcguire_dda",
        .title = "Screen-space ray tracing by a perspective-correct DDA",
        .source = "McGuire & Mara 2014, Efficient GPU Screen-Space Ray Tracing, JCGT 3(4)",
        .description = "One mirror ray per pixel, walked pixel by pixel along its line on the screen until it passes "
                       "behind a surface.",
        .needs = {"has_reflective", "min_roughness"},
        .presets = {{"published",
                     "the first interval starts at the ray's origin, as in the paper",
                     {{"dda.interval_from_origin", true}}},
                    {"coarse",
                     "every fourth pixel, dithered, with the authors' refinement",
                     {{"dda.stride", 4}, {"dda.checkerboard", true}, {"dda.refine", true}}},
                    {"any_scale",
                     "thickness as a share of the depth, for scenes of any size",
                     {{"dda.thickness", 0.0}, {"dda.relative_thickness", 0.02}}},
                    {"best",
                     "the least error that experiments/configs/search_mcguire_dda.json found",
                     {{"bilinear_color", true}, {"dda.clip_to_viewport", false}, {"max_roughness", 0.2}}}},
        .create = create<McGuireDda>,
    },
    {
        .name = "amd_sssr",
        .title = "AMD FidelityFX stochastic screen-space reflections, with their denoiser",
        .source = "FidelityFX SDK 1.1.4 (SSSR 1.5, Denoiser 1.3), MIT licence, Copyright (C) 2024 Advanced Micro "
                  "Devices, Inc.",
        .description =
            "One ray per quad or pixel, drawn from the visible normals with blue noise, is marched through a depth "
            "pyramid; rays are accumulated over frames, filtered in space and clipped to their neighbourhood.",
        .needs = {"has_reflective", "min_roughness"},
        .presets =
            {{"slides", "distances in the traversal loop as the slides of 2020 print them", {{"hierarchy.march", "slides"}}},
             {"sdk_1_5",
              "the shaders of FidelityFX SDK 1.1.4 with the defaults of its sample; of what its host code binds "
              "wrongly, "
              "the stale sample count is kept, as in version 1.3, the stale averages and the pyramid's are not",
              nlohmann::json::object()},
             {"repeatable",
              "as sdk_1_5, but subgroups do not give up their last rays: runs repeat, whatever the size of subgroups",
              {{"hierarchy.min_traversal_occupancy", 0}}},
             {"corrected",
              "every defect mended, and no early exit of thinly occupied subgroups; what only changes a choice of the "
              "original's is left as it is",
              amd_corrected},
             {"best",
              "the least error that experiments/configs/search_amd_sssr.json found, from `corrected` on: rougher "
              "surfaces traced, contact hits and thicker surfaces accepted, narrower filters, history clipped closer",
              with(amd_corrected, {{"hierarchy.max_traversal_intersections", 4096},
                                   {"roughness_threshold_alpha", 0.4},
                                   {"hierarchy.accept_contact_hits", true},
                                   {"hierarchy.depth_buffer_thickness", 0.15},
                                   {"average_pull", 0.0},
                                   {"prefilter_variance_weight", 2.2},
                                   {"radiance_weight_bias", 0.3},
                                   {"temporal_stability_factor", 0.5},
                                   {"clip_scale", 1.4}})}},
        .create = create<AmdSssr>,
    },
    {
        .name = "diligent_ssr",
        .title = "DiligentFX screen-space reflections, for machines without compute shaders",
        .source = "DiligentFX (2024-04 and 2026-07), Apache-2.0 licence, Copyright Diligent Graphics LLC",
        .description =
            "An adaptation of FidelityFX SSSR to fragment shaders: one ray per pixel through a hierarchy of depths, "
            "with a "
            "confidence in place of an environment; neighbours' rays are reused by ratio estimators, history is "
            "accumulated, and what stays noisy is filtered.",
        .needs = {"has_reflective", "min_roughness"},
        .presets = {{"documented",
                     "April 2024, as its document describes it",
                     {{"mask", "stencil"},
                      {"spatial_kernel", "double_gaussian"},
                      {"distribution_floor", false},
                      {"short_ray_guard", false},
                      {"history_search", "device_depth"}}},
                    {"current", "July 2026, with its defaults", nlohmann::json::object()},
                    {"corrected",
                     "every defect mended, and history that averages; what only changes a choice of the original's is "
                     "left as it is",
                     diligent_corrected},
                    {"best",
                     "the least error that experiments/configs/search_diligent.json found, from `corrected` on: "
                     "rougher surfaces traced",
                     with(diligent_corrected, {{"hierarchy.max_traversal_intersections", 4096},
                                               {"roughness_threshold", 0.6},
                                               {"float_roughness", true},
                                               {"hierarchy.accept_contact_hits", true},
                                               {"temporal_radiance_stability_factor", 0.8},
                                               {"spatial_reconstruction_radius", 2},
                                               {"ggx_importance_sample_bias", 0.15}})}},
        .limits = {.api = Limits::webgl2, .lifted_by = {{"hierarchy", "mip_views"}, {"tracer", "exact_scene"}}},
        .create = create<DiligentSsr>,
    },
    {
        .name = "frostbite_sssr",
        .title = "Frostbite's stochastic screen-space reflections, with ray reuse",
        .source =
            "Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, SIGGRAPH course Advances in Real-Time "
            "Rendering, as quoted by others; what they leave open is ours",
        .description =
            "Probes decide how many rays each tile gets; a hierarchical march serves smooth surfaces and linear steps "
            "rough ones; each pixel weighs its neighbours' rays by its own BRDF, takes their colours from mip levels, "
            "and blends with what it reflected in the frame before.",
        .needs = {"has_reflective", "min_roughness"},
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
              "the least error that experiments/configs/search_frostbite.json found: one ray per pixel from 0.7 of the "
              "lobe of visible normals; hits that the previous frame did not show see the environment",
              {{"half_resolution", false},
               {"lobe", "visible_normals"},
               {"importance_bias", 0.3},
               {"frostbite.relative_thickness", 0.02},
               {"hidden_hits", "miss"},
               {"cone_scale", 0.5},
               {"pattern", "interleaved"},
               {"clamp_scale", 1.0}}}},
        .create = create<FrostbiteSssr>,
    },
};

template <class T>
const T& find_named(std::span<const T> entries, const std::string& name, const std::string& what) {
    std::vector<std::string> names;
    for (const T& entry : entries) {
        if (entry.name == name) return entry;
        names.push_back(entry.name);
    }
    if (names.empty()) fail("unknown ", what, " '", name, "'; there are none");
    fail("unknown ", what, " '", name, "'", suggestion(name, names));
}

bool are_lifted(const VariantLimits& limits, const nlohmann::json& parameters) {
    for (const auto& [name, value] : limits.lifted_by.items())
        if (parameters.at(name) == value) return true;
    return false;
}

}  // namespace

std::span<const VariantEntry> variant_table() { return table; }

const VariantEntry& find_variant(const std::string& name) { return find_named<VariantEntry>(table, name, "variant"); }

std::string limits_text(const VariantLimits& limits) {
    std::string text = name_of(limits.api);
    for (const auto& [name, value] : limits.lifted_by.items())
        text += ", unless " + name + " = " + (value.is_string() ? value.get<std::string>() : value.dump());
    return text;
}

std::unique_ptr<Variant> make_variant(const std::string& name, const nlohmann::json& parameters,
                                      const std::string& preset) {
    const VariantEntry& entry = find_variant(name);
    std::unique_ptr<Variant> variant = entry.create();
    if (!preset.empty())
        variant->params.assign(
            find_named<Preset>(entry.presets, preset, "preset of variant '" + name + "':").parameters);
    try {
        if (!parameters.is_null()) variant->params.assign(parameters);
    } catch (const Error& error) {
        fail("variant '", name, "': ", error.what());
    }
    variant->limits = are_lifted(entry.limits, variant->params.values()) ? Limits::none : entry.limits.api;
    return variant;
}
