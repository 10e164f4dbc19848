#include "variants/common/variant_entry.h"
#include "variants/diligent_ssr/diligent_ssr.h"

namespace {

const nlohmann::json diligent_corrected = {{"temporal_radiance_stability_factor", 0.9},
                                           {"hierarchy.partial_texels", "clamped"},
                                           {"hierarchy.unproject_jitter", true},
                                           {"bias_towards_mirror", true},
                                           {"hierarchy.clip_ray_to_near_plane", true},
                                           {"hierarchy.relative_ray_step", true},
                                           {"inward_rays", "missed"},
                                           {"hierarchy.stop_outside_screen", true},
                                           {"hierarchy.reject_unfinished", true},
                                           {"hierarchy.finite_length", true},
                                           {"repair_inputs", true},
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

}  // namespace

VariantEntry diligent_ssr_entry() {
    return {
        .name = "diligent_ssr",
        .title = "DiligentFX screen-space reflections, for machines without compute shaders",
        .source = "DiligentFX (2024-04 and 2026-07), Apache-2.0 licence, Copyright Diligent Graphics LLC",
        .description =
            "An adaptation of FidelityFX SSSR to fragment shaders: one ray per pixel through a hierarchy of depths, "
            "with a "
            "confidence in place of an environment; neighbours' rays are reused by ratio estimators, history is "
            "accumulated, and what stays noisy is filtered.",
        .presets =
            {{"documented",
              "April 2024, as its document describes it",
              {{"mask", "stencil"},
               {"spatial_kernel", "double_gaussian"},
               {"distribution_floor", false},
               {"short_ray_guard", false},
               {"history_search", "device_depth"}}},
             {"current", "July 2026, with its defaults", nlohmann::json::object()},
             {"corrected",
              "every defect fixed, and history that averages; deliberate choices of the original are unchanged",
              diligent_corrected},
             {"best",
              "the least error that a search found (search_diligent.json of commit 5cf9fef), from `corrected` on: "
              "rougher surfaces traced",
              changed(diligent_corrected, {{"hierarchy.max_traversal_intersections", 4096},
                                           {"roughness_threshold", 0.6},
                                           {"float_roughness", true},
                                           {"hierarchy.accept_contact_hits", true},
                                           {"temporal_radiance_stability_factor", 0.8},
                                           {"spatial_reconstruction_radius", 2},
                                           {"ggx_importance_sample_bias", 0.15}})}},
        .limits = {.api = Limits::webgl2, .lifted_by = {{"hierarchy", "mip_views"}, {"tracer", "exact_scene"}}},
        .create = [] { return std::make_unique<DiligentSsr>(); },
    };
}
