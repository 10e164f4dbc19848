#pragma once
#include "variants/common/blue_noise.h"
#include "variants/common/lit_history.h"
#include "variants/diligent_ssr/filter_parameters.h"
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
    bool is_left_out_ = false, has_mirrors_only_ = false, is_still_ = false;
};
