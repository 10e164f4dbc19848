#pragma once
#include "variants/tracers/tracing_variant.h"

/// The four-mode reflection pass of an engine: its documentation of 2026-01-14 is "the document". Parameters have its
/// names, in this project's spelling, and its defaults; those of its two marches are the tracers' `fixed_stride` and
/// `cells`. README.md explains how the document is interpreted, and its errors.
class FourModeSsr final : public TracingVariant {
public:
    FourModeSsr();
    bool depends_on_seed() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers; }
    std::string slot() const { return mode.is("simple_linear") ? "linear_tracer" : "tracer"; }
    bool is_stochastic() const { return mode.is("stochastic") || mode.is("temporal"); }

    // clang-format off
    Choice mode{params, "mode", "hiz", {"simple_linear", "hiz", "stochastic", "temporal"},
        {"", "simple_linear: a mirror ray by `linear_tracer`; hiz: a mirror ray by `tracer`; stochastic: `num_rays` rays of the GGX "
         "lobe by `tracer`; temporal: the same, blended with the frames before", "the document: 0 to 3, HiZ by default"}};
    Param<float> roughness_fade{params, "roughness_fade", 0.5f, {0.01f, 1.0f},
        {"perceptual", "roughness at which nothing is left of the confidence, which falls to it in proportion", "the document"}};
    Param<float> intensity{params, "intensity", 1.0f, {0.0f, 1.0f}, {"", "factor of the confidence", "the document"}};
    Param<unsigned> num_rays{params, "num_rays", 4, {1, 8},
        {"rays", "of each pixel in the modes stochastic and temporal",
         "the document: 1, 2, 4 and 8 at its qualities Low to Ultra; 2 where it quotes the time of temporal"}};
    Param<float> brdf_bias{params, "brdf_bias", 0.5f, {0.0f, 1.0f},
        {"of the rays", "share that is drawn about GGX normals; the others go anywhere above the surface with one density",
         "the document: a blend of uniform and GGX sampling, 0.5, without a formula; that it is a mixture is ssrlab's"}};
    Choice weights{params, "weights", "none", {"none", "ratio"},
        {"", "of the rays of a pixel in their mean. none: all alike; ratio: the density of the lobe of visible normals over that of "
         "the mixture which they were drawn from, divided by the sum", "none: the document, which names no weight; ratio: ssrlab"}};

    // Mode temporal.
    Param<float> temporal_blend{params, "temporal_blend", 0.9f, {0.0f, 0.98f}, {"", "share of the history where nothing moves", "the document"}};
    Param<float> motion_threshold{params, "motion_threshold", 0.01f, {0.001f, 0.1f},
        {"uv", "motion on the screen at which nothing is taken of the history, of which the share falls to it in proportion",
         "the document: the number; the linear fall is ssrlab's"}};
    Choice history_place{params, "history_place", "camera", {"camera", "motion_vectors"},
        {"", "where the surface was in the frame before. camera: by the previous camera, as if nothing but it moved",
         "the document specifies motion vectors, but its algorithm uses the previous camera's matrix"}};
    Switch neighborhood_clamp{params, "neighborhood_clamp", true,
        {"", "clamps the history to the least and largest of the 3x3 neighbours, each channel and the confidence alone", "the document"}};
    Switch reject_other_surfaces{params, "reject_other_surfaces", false,
        {"", "takes nothing of the history where the frame before showed another surface, by 1 % of its distance", "ssrlab; the document has no test"}};
    Switch weigh_by_confidence{params, "weigh_by_confidence", false,
        {"", "blends and clamps colour times confidence, which is what is shown, and not both alone: half a hit and half a miss are "
         "half as much", "ssrlab; the document blends its texture's channels"}};
    // clang-format on
    Tracers tracers;

    bool is_left_out_ = false;
};
