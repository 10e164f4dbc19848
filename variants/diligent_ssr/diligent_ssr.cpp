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
    const bool is_white = tracing_.noise.is("white");
    const Image noise =
        is_white || tracing_.independent_noise_shifts
            ? noise_.render(graph, is_white ? NoiseShift::white : NoiseShift::r2, NoisePrecision::float_32,
                            NoiseStage::fragment)
            : noise_.render(graph, NoiseShift::golden_diagonal_from_half, NoisePrecision::bits_8, NoiseStage::fragment);
    const Image reprojected_depth = diligent_reprojected_depth(graph, gbuffer);
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

std::vector<LeftOut> DiligentSsr::leave_out_passes(const SceneFacts& facts) {
    const float min_roughness =
        tracing_.float_roughness ? facts.min_roughness : diligent_roughness_of_8_bits(facts.min_roughness);
    is_left_out_ = !facts.has_reflective || min_roughness > tracing_.roughness_threshold;
    if (!is_left_out_) return {};
    const bool is_guided = filter_.bilateral_cleanup && filter_.cleanup.is("guided");
    std::vector<std::string> stages = {"common/blue_noise",
                                       "diligent_ssr/reprojected_depth",
                                       "diligent_ssr/mask",
                                       "diligent_ssr/intersection",
                                       "diligent_ssr/spatial_reconstruction",
                                       "diligent_ssr/temporal_accumulation",
                                       is_guided ? "diligent_ssr/guided_cleanup" : "diligent_ssr/bilateral_cleanup"};
    if (is_guided) stages.push_back("diligent_ssr/guided_coefficients");
    if (tracing_.tracers.needs_pyramid()) stages.push_back("diligent_ssr/depth_hierarchy");
    if (tracing_.half_resolution) stages.push_back("diligent_ssr/half_resolution_mask");
    if (tracing_.previous_frame) stages.push_back("common/keep_lit");
    return left_out_without_rays(facts, "as smooth as roughness_threshold", stages);
}
