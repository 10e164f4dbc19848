#include "variants/amd_sssr/amd_sssr.h"
#include "variants/common/variant_entry.h"

namespace {

const nlohmann::json amd_corrected = {{"hierarchy.min_traversal_occupancy", 0},
                                      {"hierarchy.thickness_at_hit_mip", true},
                                      {"independent_noise_shifts", true},
                                      {"trace_orphans", true},
                                      {"hierarchy.clip_ray_to_near_plane", true},
                                      {"hierarchy.zero_direction", "nudged"},
                                      {"guard_mirror_normal", true},
                                      {"redraw_below_horizon", true},
                                      {"inward_rays", "black"},
                                      {"hierarchy.stop_outside_screen", true},
                                      {"hierarchy.partial_texels", "near_plane"},
                                      {"hierarchy.reject_unfinished", true},
                                      {"hierarchy.finite_length", true},
                                      {"repair_inputs", true},
                                      {"rate_stored_roughness", true},
                                      {"barrier_before_average", true},
                                      {"current_sample_count", true},
                                      {"no_dark_exit", true},
                                      {"running_variance", true},
                                      {"round_up_tiles", true},
                                      {"reproject_history_depth", true},
                                      {"guard_previous_clip", true},
                                      {"finite_neighborhood", true},
                                      {"fresh_neighborhood", true},
                                      {"float_histories", true}};

}  // namespace

VariantEntry amd_sssr_entry() {
    return {
        .name = "amd_sssr",
        .title = "AMD FidelityFX stochastic screen-space reflections, with their denoiser",
        .source =
            "FidelityFX SDK 1.1.4 (SSSR 1.5, Denoiser 1.3), MIT licence, Copyright (C) 2024 Advanced Micro "
            "Devices, Inc.",
        .description =
            "One ray per quad or pixel, drawn from the visible normals with blue noise, is marched through a depth "
            "pyramid; rays are accumulated over frames, filtered in space and clipped to their neighbourhood.",
        .presets =
            {{"slides",
              "distances in the traversal loop as the slides of 2020 print them",
              {{"hierarchy.march", "slides"}}},
             {"sdk_1_5",
              "the shaders of FidelityFX SDK 1.1.4 with the defaults of its sample; of what its host code binds "
              "wrongly, "
              "the stale sample count is kept, as in version 1.3, the stale averages and the pyramid's are not",
              nlohmann::json::object()},
             {"repeatable",
              "as sdk_1_5, but subgroups do not give up their last rays: repeatable for every size of subgroups",
              {{"hierarchy.min_traversal_occupancy", 0}}},
             {"corrected",
              "every defect fixed, and no early exit of thinly occupied subgroups; deliberate choices of the original "
              "are unchanged",
              amd_corrected},
             {"best",
              "the least error that a search found (search_amd_sssr.json of commit 5cf9fef), from `corrected` on: "
              "rougher "
              "surfaces traced, contact hits and thicker surfaces accepted, narrower filters, history clipped closer",
              changed(amd_corrected, {{"hierarchy.max_traversal_intersections", 4096},
                                      {"roughness_threshold_alpha", 0.4},
                                      {"hierarchy.accept_contact_hits", true},
                                      {"hierarchy.depth_buffer_thickness", 0.15},
                                      {"average_pull", 0.0},
                                      {"prefilter_variance_weight", 2.2},
                                      {"radiance_weight_bias", 0.3},
                                      {"temporal_stability_factor", 0.5},
                                      {"clip_scale", 1.4}})}},
        .create = [] { return std::make_unique<AmdSssr>(); },
    };
}
