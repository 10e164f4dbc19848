#pragma once
#include "core/gbuffer/split_sum_image.h"
#include "variants/common/lit_history.h"
#include "variants/frostbite_sssr/horizon_image.h"
#include "variants/frostbite_sssr/ray_parameters.h"
#include "variants/frostbite_sssr/resolve_parameters.h"
#include "variants/tracers/tracing_variant.h"

/// Stochastic screen-space reflections as Frostbite's authors presented them: Stachowiak and Uludag 2015, "Stochastic
/// Screen-Space Reflections", SIGGRAPH course Advances in Real-Time Rendering. Much of it was never published;
/// README.md says what is theirs and what is ours.
class FrostbiteSssr final : public TracingVariant {
private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return ray_.tracers; }

    FrostbiteRayParameters ray_{params};
    FrostbiteResolveParameters resolve_{params};
    LitHistory lit_;
    SplitSumImage split_sum_;
    FrostbiteHorizonImage horizon_;
    bool is_left_out_ = false;
    bool has_smooth_rays_ = true, has_rough_rays_ = true, filters_color_ = true;  // until leave_out()
};
