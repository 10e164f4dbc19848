#include "variants/amd_sssr/denoiser_parameters.h"
#include "variants/amd_sssr/mirror.h"
#include "variants/amd_sssr/passes.h"
#include "variants/amd_sssr/tracing_parameters.h"
#include "variants/common/blue_noise.h"
#include "variants/common/variant_entry.h"
#include "variants/tracers/tracing_variant.h"

/// AMD FidelityFX Stochastic Screen-Space Reflections with its reflection denoiser, as the shaders of FidelityFX SDK
/// 1.1.4 compute them (effects SSSR 1.5 and Denoiser 1.3, MIT licence). Defaults are those of AMD's sample.
///
/// README.md explains the passes, lists the deviations, and names the parameter that fixes each defect of the original.
class AmdSssr final : public TracingVariant {
public:
    bool depends_on_seed() const override;
    std::string not_repeatable() const override;
    ShaderIncludes shader_includes() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    Image noise(PassGraph& graph);
    const Tracers& chosen_tracers() const override { return tracing_.tracers; }

    AmdTracingParameters tracing_{params};
    AmdDenoiserParameters denoiser_{params};
    BlueNoise noise_;
    bool draws_nothing_ = false;
};

Reflections AmdSssr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image confidence = graph.image("confidence", Format::r8);
    const AmdHistories histories = amd_histories(graph, denoiser_.float_histories, tracing_.float_roughness);
    const Tracers::Images traced_images = tracing_.tracers.images(graph, gbuffer.depth);
    const AmdWork work = amd_classify(graph, gbuffer, histories, confidence, denoiser_);
    const Image noise = draws_nothing_ ? noise_.table(graph) : this->noise(graph);
    amd_prepare_arguments(graph, work);
    amd_intersect(graph, gbuffer, traced_images, noise, work, histories, tracing_, ray_probe);
    if (denoiser_.denoise) amd_denoise(graph, gbuffer, work, histories, denoiser_);
    return {histories.radiance.current, confidence};
}

Image AmdSssr::noise(PassGraph& graph) {
    const bool is_white = tracing_.noise.is("white");
    if (is_white || tracing_.independent_noise_shifts)
        return noise_.render(graph, is_white ? NoiseShift::white : NoiseShift::r2, NoisePrecision::float_32);
    return noise_.render(graph, NoiseShift::golden_diagonal);
}

TracingVariant::Needless AmdSssr::find_needless(const SceneFacts& facts) {
    const auto stored = [&](float roughness) {
        const float alpha = roughness * roughness;
        return tracing_.float_roughness ? alpha : amd_alpha_of_8_bits(alpha);
    };
    const float smoothest =
        tracing_.rate_stored_roughness ? stored(facts.min_roughness) : facts.min_roughness * facts.min_roughness;
    Needless needless{
        .such_a_surface = "below roughness_threshold_alpha",
        .stages = {"amd_sssr/classify", "common/blue_noise", "amd_sssr/prepare_arguments", "amd_sssr/intersect"}};
    needless.rays = !facts.has_reflective || smoothest >= tracing_.roughness_threshold_alpha;
    if (tracing_.tracers.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (denoiser_.denoise)
        needless.stages.insert(needless.stages.end(),
                               {"amd_sssr/reproject", "amd_sssr/prefilter", "amd_sssr/resolve_temporal"});

    const bool has_mirrors_only = stored(facts.max_roughness) < amd_mirror_alpha;
    const std::string fact = "all that reflects is a mirror";
    draws_nothing_ = has_mirrors_only && tracing_.guard_mirror_normal;
    if (draws_nothing_) {
        needless.parts.push_back({"common/blue_noise", fact, "rays of mirrors are not drawn at random"});
        needless.constants["draw_directions"] = false;
    }
    if (has_mirrors_only && denoiser_.denoise && denoiser_.prefilter) {
        needless.parts.push_back({"neighbours", fact, "mirrors are not filtered in space", "amd_sssr/prefilter"});
        needless.constants["prefilter"] = false;
    }
    needless.specular_readers = {"amd_sssr/classify"};
    if (denoiser_.denoise) needless.motion_readers = {"amd_sssr/reproject"};
    if (tracing_.misses.is("fallback")) needless.environment_readers = {"amd_sssr/intersect"};
    return needless;
}

/// Without the one no surface is smooth enough to start a ray, without the other every ray is the mirror's.
bool AmdSssr::depends_on_seed() const {
    return tracing_.roughness_threshold_alpha > 0 && (tracing_.draw_directions || tracing_.tracers.needs().random);
}

ShaderIncludes AmdSssr::shader_includes() const {
    ShaderIncludes includes = TracingVariant::shader_includes();
    includes.merge(amd_denoiser_includes(denoiser_));
    return includes;
}

std::string AmdSssr::not_repeatable() const {
    // Pixels enter the ray list in the order in which atomics let them.
    const std::string of_rays = tracing_.tracers.not_repeatable(), of_denoiser = amd_denoiser_not_repeatable(denoiser_);
    return of_rays + (of_rays.empty() || of_denoiser.empty() ? "" : "; ") + of_denoiser;
}

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
              {{"hierarchy.march", "slides"}, {"denoiser_form", "faithful"}}},
             {"sdk_1_5",
              "the shaders of FidelityFX SDK 1.1.4 with the defaults of its sample; of what its host code binds "
              "wrongly, "
              "the stale sample count is kept, as in version 1.3, the stale averages and the pyramid's are not",
              {{"denoiser_form", "faithful"}}},
             {"repeatable",
              "as sdk_1_5, but subgroups do not give up their last rays: repeatable for every size of subgroups; on a "
              "CPU its "
              "denoiser is laid out for one (denoiser_form), with the same output within half-float rounding",
              {{"hierarchy.min_traversal_occupancy", 0}}},
             {"corrected",
              "every defect fixed, and no early exit of thinly occupied subgroups; deliberate choices of the original "
              "are unchanged",
              amd_corrected},
             {"best",
              "the least error that a search before `ssrlab tune` found (commit 5cf9fef), from `corrected` on: "
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
