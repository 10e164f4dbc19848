#include "variants/amd_sssr/passes.h"
#include "variants/resolves/resolve.h"

#include <cmath>

namespace {

/// FidelityFX Denoiser 1.3 as in amd_sssr: its classification rates pixels and lists tiles, and what rays saw stands in
/// place of what its intersection stores.
class AmdDenoiser final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const OwnRays own = average_own_rays(graph, gbuffer, rays);
        // Above the alpha of the roughest surface that is traced, which roughness_threshold_alpha excludes.
        const float alpha = rays.draw.max_roughness * rays.draw.max_roughness;
        use_own_params(graph, {{"roughness_threshold_alpha", std::min(std::nextafter(alpha, 2.0f), 1.0f)},
                               {"misses", rays.misses_are_known ? "fallback" : "weight"},
                               {"rate_stored_roughness", true},
                               {"float_roughness", true}});
        const Image confidence = graph.image("confidence", Format::r8);
        const AmdHistories histories = amd_histories(graph, denoiser_.float_histories, tracing_.float_roughness);
        const AmdWork work = amd_classify(graph, gbuffer, histories, confidence, denoiser_);
        amd_prepare_arguments(graph, work);
        graph.compute("resolves/amd_denoiser/inputs.comp")
            .read(own.radiance)
            .read(own.ray_length)
            .read(histories.roughness.current)
            .read(gbuffer.fallback)
            .write(histories.radiance.current)
            .run();
        if (denoiser_.denoise) amd_denoise(graph, gbuffer, work, histories, denoiser_);
        return {histories.radiance.current, confidence};
    }

    std::vector<std::string> stages() const override {
        std::vector<std::string> stages = {"resolves/own_rays", "amd_sssr/classify", "amd_sssr/prepare_arguments",
                                           "resolves/amd_denoiser/inputs"};
        if (denoiser_.denoise)
            stages.insert(stages.end(), {"amd_sssr/reproject", "amd_sssr/prefilter", "amd_sssr/resolve_temporal"});
        return stages;
    }
    std::string not_repeatable() const override { return amd_denoiser_not_repeatable(denoiser_); }
    StageReads reads() const override {
        StageReads reads{
            .rays = "resolves/own_rays", .motion = {}, .specular = {"resolves/own_rays", "amd_sssr/classify"}};
        if (denoiser_.denoise) reads.motion = {"amd_sssr/reproject"};
        return reads;
    }

private:
    AmdDenoiserParameters denoiser_{params};
    AmdTracingParameters tracing_{params};
};

}  // namespace

ResolveEntry amd_denoiser_resolve() {
    return {
        .name = "amd_denoiser",
        .title = "AMD FidelityFX's reflection denoiser",
        .source = "FidelityFX SDK 1.1.4 (Denoiser 1.3), MIT licence, Copyright (C) 2024 Advanced Micro Devices, Inc.",
        .description =
            "What is not known of the rays is the fallback; history by the ray's length, a filter of 15 neighbours "
            "as strong as the pixel changes, history clipped to the moments of 9x9 pixels.",
        .folder = "variants/resolves/amd_denoiser/",
        .needs_density = false,
        .declare = [](ParameterSet& params) { AmdDenoiserParameters{params}; },
        .create = [] { return std::make_unique<AmdDenoiser>(); }};
}
