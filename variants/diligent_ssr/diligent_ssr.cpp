#include "variants/common/blue_noise.h"
#include "variants/common/lit_history.h"
#include "variants/common/variant_entry.h"
#include "variants/diligent_ssr/filter_parameters.h"
#include "variants/diligent_ssr/passes.h"
#include "variants/diligent_ssr/tracing_parameters.h"
#include "variants/tracers/tracing_variant.h"

/// DiligentFX's screen-space reflection (Apache-2.0 licence), an adaptation of AMD FidelityFX SSSR to machines without
/// compute shaders. Defaults are those of the effect as of July 2026.
///
/// README.md explains the passes, lists the deviations, and names the parameter that fixes each defect of the original.
class DiligentSsr final : public TracingVariant {
public:
    bool depends_on_seed() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    Image noise(PassGraph& graph);
    const Tracers& chosen_tracers() const override { return tracing_.tracers; }

    DiligentTracingParameters tracing_{params};
    DiligentFilterParameters filter_{params};
    BlueNoise noise_;
    LitHistory lit_;
    bool has_mirrors_only_ = false, is_still_ = false;
};

Reflections DiligentSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image noise = has_mirrors_only_ ? noise_.table(graph) : this->noise(graph);
    const Image reprojected_depth =
        is_still_ ? gbuffer.depth.as("reprojected_depth") : diligent_reprojected_depth(graph, gbuffer);
    const Tracers::Images hierarchies = diligent_depth_hierarchies(graph, gbuffer, tracing_);
    const DiligentMask mask = diligent_mask(graph, gbuffer, tracing_, filter_);
    const Image color = tracing_.previous_frame ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit;
    const DiligentRays rays = diligent_trace(graph, gbuffer, hierarchies, noise, color, mask, tracing_, ray_probe);
    const DiligentResolved resolved = diligent_reconstruct(graph, gbuffer, rays, mask, filter_);
    const DiligentHistories histories = diligent_histories(graph, filter_);
    diligent_accumulate(graph, gbuffer, reprojected_depth, resolved, histories, mask, filter_);
    const Image reflections =
        diligent_cleanup(graph, gbuffer, histories.radiance.current, histories.variance.current, mask, filter_);
    return {reflections, reflections, 3};
}

/// Perfect mirrors draw nothing, nor does a lobe of which the mirror direction alone is left.
bool DiligentSsr::depends_on_seed() const {
    const bool has_lobes = tracing_.roughness_threshold > 0;
    const bool has_mirror_rays_only = tracing_.bias_towards_mirror && tracing_.ggx_importance_sample_bias == 1;
    return has_lobes && (!has_mirror_rays_only || tracing_.tracers.needs().random);
}

Image DiligentSsr::noise(PassGraph& graph) {
    const bool is_white = tracing_.noise.is("white");
    if (is_white || tracing_.independent_noise_shifts)
        return noise_.render(graph, is_white ? NoiseShift::white : NoiseShift::r2, NoisePrecision::float_32,
                             NoiseStage::fragment);
    return noise_.render(graph, NoiseShift::golden_diagonal_from_half, NoisePrecision::bits_8, NoiseStage::fragment);
}

TracingVariant::Needless DiligentSsr::find_needless(const SceneFacts& facts) {
    const auto stored = [&](float roughness) {
        return tracing_.float_roughness ? roughness : diligent_roughness_of_8_bits(roughness);
    };
    const bool is_guided = filter_.bilateral_cleanup && filter_.cleanup.is("guided");
    Needless needless{.such_a_surface = "as smooth as roughness_threshold",
                      .stages = {"common/blue_noise", "diligent_ssr/reprojected_depth", "diligent_ssr/mask",
                                 "diligent_ssr/intersection", "diligent_ssr/spatial_reconstruction",
                                 "diligent_ssr/temporal_accumulation",
                                 is_guided ? "diligent_ssr/guided_cleanup" : "diligent_ssr/bilateral_cleanup"}};
    needless.rays = !facts.has_reflective || stored(facts.min_roughness) > tracing_.roughness_threshold;
    if (is_guided) needless.stages.push_back("diligent_ssr/guided_coefficients");
    if (tracing_.tracers.needs_pyramid()) needless.stages.push_back("diligent_ssr/depth_hierarchy");
    if (tracing_.half_resolution) needless.stages.push_back("diligent_ssr/half_resolution_mask");
    if (tracing_.previous_frame) needless.stages.push_back("common/keep_lit");

    is_still_ = facts.is_still();
    if (is_still_)
        needless.parts.push_back(
            {"diligent_ssr/reprojected_depth", "nothing moves", "it is the depth itself", "", false});
    has_mirrors_only_ = stored(facts.max_roughness) == 0.0f;
    if (has_mirrors_only_) {
        const std::string fact = "all that reflects is a mirror";
        needless.parts.push_back({"common/blue_noise", fact, "rays of mirrors are not drawn at random"});
        if (filter_.bilateral_cleanup && !is_guided) {
            needless.parts.push_back(
                {"neighbours", fact, "mirrors are not filtered", "diligent_ssr/bilateral_cleanup"});
            needless.constants["bilateral_cleanup"] = false;
        }
    }
    needless.specular_readers = {"diligent_ssr/mask"};
    if (filter_.temporal_accumulation) needless.motion_readers = {"diligent_ssr/temporal_accumulation"};
    if (tracing_.previous_frame) needless.motion_readers.push_back("diligent_ssr/intersection");
    if (tracing_.misses.is("fallback")) needless.environment_readers = {"diligent_ssr/intersection"};
    return needless;
}

namespace {

const nlohmann::json diligent_april_2024 = {{"mask", "stencil"},
                                            {"spatial_kernel", "double_gaussian"},
                                            {"distribution_floor", false},
                                            {"short_ray_guard", false},
                                            {"history_search", "device_depth"}};

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
        .presets = {{"april_2024", "the shaders of commit e96a1d4 of April 2024, whose README is the document",
                     diligent_april_2024},
                    {"document_text",
                     "april_2024 with what the document's text says in place of its shaders: visible normals by "
                     "Heitz's disk, a number of samples by the roughness, a sigma from the variance",
                     changed(diligent_april_2024,
                             {{"half_vectors", "disk"}, {"variable_samples", true}, {"sigma_from_variance", true}})},
                    {"current", "July 2026, with its defaults, within WebGL 2", nlohmann::json::object()},
                    {"vulkan",
                     "current as the original runs on Vulkan: levels of the hierarchy are read one by one, without "
                     "the copies that WebGL 2 needs",
                     {{"hierarchy", "mip_views"}}},
                    {"corrected",
                     "every defect fixed, and history that averages; deliberate choices of the original are unchanged",
                     diligent_corrected},
                    {"best",
                     "the least error that a search before `ssrlab tune` found (commit 5cf9fef), from `corrected` on: "
                     "rougher surfaces traced",
                     changed(diligent_corrected, {{"hierarchy.max_traversal_intersections", 4096},
                                                  {"roughness_threshold", 0.6},
                                                  {"float_roughness", true},
                                                  {"hierarchy.accept_contact_hits", true},
                                                  {"temporal_radiance_stability_factor", 0.8},
                                                  {"spatial_reconstruction_radius", 2},
                                                  {"ggx_importance_sample_bias", 0.15}})}},
        .limits = {.api = Limits::webgl2, .lifted_by = {{"hierarchy", "mip_views"}}},
        .create = [] { return std::make_unique<DiligentSsr>(); },
    };
}
