#pragma once
#include "variants/common/lit_history.h"
#include "variants/tracers/tracing_variant.h"

/// The simple techniques that two of our sources start from, as values of a few parameters: mirror rays alone, mirror
/// rays with a uniform blur, jittered rays averaged without reuse ("slides": the introduction of Stachowiak and Uludag
/// 2015, "Stochastic Screen-Space Reflections", as quoted by others), and the march through a hierarchical depth buffer
/// of a blog ("the article": "Screen Space Ray Reflection", 2023). README.md says what each leaves open.
class SimpleSsr final : public TracingVariant {
public:
    bool depends_on_seed() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers; }
    bool blurs() const { return blur_width > 0; }

    // clang-format off
    Choice draw{params, "draw", "mirror", {"mirror", "jittered_ray", "normals", "visible_normals", "cosine"},
        {"", "where rays go. jittered_ray: by a lobe about the mirror direction, as wide as that of a view along the normal; "
         "normals: mirrored about a normal of the GGX distribution; visible_normals: about one of those that the viewer sees; "
         "cosine: anywhere above the surface, by the cosine",
         "slides: mirror, then jittered; the article: mirror or by importance; AMD's slides show jittered_ray beside visible_normals"}};
    Param<unsigned> rays{params, "rays", 1, {1, 16}, {"rays", "of each pixel, unless all are its mirror ray", "slides: few"}};
    Choice weights{params, "weights", "ratio", {"none", "ratio"},
        {"", "of the rays of a pixel in their mean. none: all alike, for any distribution; ratio: the density of the lobe of "
         "visible normals over that which they were drawn with, divided by the sum, so that many rays of any draw come to the same "
         "mean; a single ray has the same colour either way",
         "none: slides and article, which name no weight; ratio: ssrlab"}};
    Param<unsigned> max_regenerations{params, "max_regenerations", 4, {0, 16},
        {"", "times that a ray below the horizon is drawn again; the last one is not traced and does not count", "ssrlab"}};
    Switch rule_of_45_degrees{params, "rule_of_45_degrees", false,
        {"", "traces no ray where the view meets the surface at less than 45 degrees from its normal: what such pixels reflect is "
         "said to be behind the camera", "slides, as quoted by others"}};
    Param<float> max_roughness{params, "max_roughness", 0.6f, {0.0f, 1.0f},
        {"perceptual", "rougher surfaces are left to the fallback", "ssrlab"}};
    Switch previous_frame{params, "previous_frame", false,
        {"", "hits show the lit image of the frame before, at the place where their surface was; otherwise that of this frame",
         "slides and article: on, for an engine has not lit this frame yet"}};
    Param<float> blur_width{params, "blur_width", 0.0f, {0.0f, 0.25f},
        {"of the screen's height", "half the side of the square over which a pixel of roughness 1 averages its neighbours' "
         "reflections, all weighed alike; smoother ones in proportion, 32 pixels at most; 0: no blur",
         "slides, of Killzone Shadow Fall, without a number"}};
    // clang-format on
    Tracers tracers{params,
                    {{"tracer", "trace", "view_space", "the march that finds what a ray meets"}},
                    "slides: equal steps in view space; the article: hzb"};

    LitHistory lit_;
    bool is_left_out_ = false, is_sharp_ = false;
};
