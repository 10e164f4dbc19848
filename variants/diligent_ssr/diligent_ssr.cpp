#include "variants/diligent_ssr/diligent_ssr.h"

#include "variants/diligent_ssr/passes.h"

namespace {

constexpr unsigned alpha = 3;  // channel of `reflections` that holds the confidence

}  // namespace

Reflections DiligentSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    if (is_left_out_) {
        const Image nothing = graph.image("reflections", Format::rgba16f);
        graph.clear(nothing, {});
        return {nothing, nothing, alpha};
    }
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
    return {reflections, reflections, alpha};
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
    needless.rays = is_left_out_ = !facts.has_reflective || stored(facts.min_roughness) > tracing_.roughness_threshold;
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
    if (filter_.temporal_accumulation) needless.motion_readers = {"diligent_ssr/temporal_accumulation"};
    if (tracing_.previous_frame) needless.motion_readers.push_back("diligent_ssr/intersection");
    if (tracing_.misses.is("fallback")) needless.environment_readers = {"diligent_ssr/intersection"};
    return needless;
}
