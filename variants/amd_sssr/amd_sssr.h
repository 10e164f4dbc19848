#pragma once
#include "variants/amd_sssr/denoiser_parameters.h"
#include "variants/amd_sssr/tracing_parameters.h"
#include "variants/common/blue_noise.h"
#include "variants/tracers/tracing_variant.h"

/// AMD FidelityFX Stochastic Screen-Space Reflections with its reflection denoiser, as the shaders of FidelityFX SDK
/// 1.1.4 compute them (effects SSSR 1.5 and Denoiser 1.3, MIT licence). Defaults are those of AMD's sample.
///
/// README.md explains the passes, lists the deviations, and names the parameter that fixes each defect of the original.
class AmdSssr final : public TracingVariant {
public:
    bool depends_on_seed() const override;
    std::string not_repeatable() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    Image noise(PassGraph& graph);
    const Tracers& chosen_tracers() const override { return tracing_.tracers; }

    AmdTracingParameters tracing_{params};
    AmdDenoiserParameters denoiser_{params};
    BlueNoise noise_;
    bool is_left_out_ = false, draws_nothing_ = false;
};
