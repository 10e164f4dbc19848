#pragma once
#include "variants/tracers/tracing_variant.h"

/// One mirror ray per pixel, and the lit colour where it ends: the plainest technique. Its own tracer is McGuire & Mara
/// 2014, "Efficient GPU Screen-Space Ray Tracing", Journal of Computer Graphics Techniques 3(4). The image `hit` of the
/// graph (rgba32f) keeps where each ray ended: uv on the un-jittered screen, distance (m), confidence, 0 of misses.
class McGuireDda final : public TracingVariant {
public:
    bool depends_on_seed() const override { return tracers.needs().random; }

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers; }

    bool is_left_out_ = false;

    // clang-format off
    Switch bilinear_color{params, "bilinear_color", false,
        {"", "filters the colour at the hit bilinearly; otherwise it is that of the tested pixel", "ssrlab"}};
    Param<float> max_roughness{params, "max_roughness", 0.6f, {0.0f, 1.0f},
        {"perceptual", "rougher surfaces are left to the fallback", "ssrlab; the paper traces mirrors only"}};
    Switch trace_inward_rays{params, "trace_inward_rays", true,
        {"", "also traces mirror rays that shading normals turn below the geometric surface",
         "McGuire & Mara 2014 do not distinguish them"}};
    // clang-format on
    Tracers tracers{
        params, {{"tracer", "trace", "dda", "the march that finds what a ray meets"}}, "McGuire & Mara 2014: dda"};
};
