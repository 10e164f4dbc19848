#include "variants/amd_sssr/amd_sssr.h"

#include "variants/amd_sssr/passes.h"

Reflections AmdSssr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image confidence = graph.image("confidence", Format::r8);
    const AmdHistories histories = amd_histories(graph, denoiser_.float_histories, tracing_.float_roughness);
    if (is_left_out_) {
        for (const Image& image : {histories.radiance.current, confidence}) graph.clear(image, {});
        return {histories.radiance.current, confidence};
    }
    const Tracers::Images traced_images = tracing_.tracers.images(graph, gbuffer.depth);
    const AmdWork work = amd_classify(graph, gbuffer, histories, confidence);
    const bool is_white = tracing_.noise.is("white");
    const Image noise =
        is_white || tracing_.independent_noise_shifts
            ? noise_.render(graph, is_white ? NoiseShift::white : NoiseShift::r2, NoisePrecision::float_32)
            : noise_.render(graph, NoiseShift::golden_diagonal);
    amd_prepare_arguments(graph, work);
    amd_intersect(graph, gbuffer, traced_images, noise, work, histories, tracing_, ray_probe);
    if (denoiser_.denoise) amd_denoise(graph, gbuffer, work, histories, denoiser_);
    return {histories.radiance.current, confidence};
}

std::vector<LeftOut> AmdSssr::leave_out_passes(const SceneFacts& facts) {
    const float exact_alpha = facts.min_roughness * facts.min_roughness;
    const bool is_rounded = tracing_.rate_stored_roughness && !tracing_.float_roughness;
    const float smoothest_alpha = is_rounded ? amd_alpha_of_8_bits(exact_alpha) : exact_alpha;
    is_left_out_ = !facts.has_reflective || smoothest_alpha >= tracing_.roughness_threshold_alpha;
    if (!is_left_out_) return {};
    std::vector<std::string> stages = {"amd_sssr/classify", "common/blue_noise", "amd_sssr/prepare_arguments",
                                       "amd_sssr/intersect"};
    if (tracing_.tracers.needs_pyramid()) stages.insert(stages.begin(), "common/depth_pyramid");
    if (denoiser_.denoise)
        stages.insert(stages.end(), {"amd_sssr/reproject", "amd_sssr/prefilter", "amd_sssr/resolve_temporal"});
    return left_out_without_rays(facts, "below roughness_threshold_alpha", stages);
}

/// Without the one no surface is smooth enough to start a ray, without the other every ray is the mirror's.
bool AmdSssr::depends_on_seed() const {
    return tracing_.roughness_threshold_alpha > 0 && (tracing_.draw_directions || tracing_.tracers.needs().random);
}

std::string AmdSssr::not_repeatable() const {
    // Pixels enter the ray list in the order in which atomics let them.
    std::string why = tracing_.tracers.not_repeatable();
    if (denoiser_.denoise && denoiser_.denoiser_form.is("faithful") && !denoiser_.barrier_before_average)
        why += std::string(why.empty() ? "" : "; ") +
               "denoiser_form = faithful without barrier_before_average: a tile's average may overwrite moments that "
               "other threads have still to read";
    return why;
}
