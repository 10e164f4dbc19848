#include "variants/amd_sssr/amd_sssr.h"

#include "variants/amd_sssr/mirror.h"
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
    needless.rays = is_left_out_ = !facts.has_reflective || smoothest >= tracing_.roughness_threshold_alpha;
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
    if (denoiser_.denoise) needless.motion_readers = {"amd_sssr/reproject"};
    if (tracing_.misses.is("fallback")) needless.environment_readers = {"amd_sssr/intersect"};
    return needless;
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
