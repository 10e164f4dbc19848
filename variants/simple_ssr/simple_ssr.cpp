#include "variants/common/lit_history.h"
#include "variants/common/variant_entry.h"
#include "variants/simple_ssr/blur.h"
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
    bool blurs() const { return blur_.blur_width > 0; }

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
    // clang-format on
    SimpleBlurParameters blur_{params};
    Tracers tracers{params,
                    {{"tracer", "trace", "view_space", "the march that finds what a ray meets"}},
                    "slides: equal steps in view space; the article: hzb"};

    LitHistory lit_;
    bool is_sharp_ = false;
};

Reflections SimpleSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image traced = graph.image("traced", Format::rgba32f);
    const Image shown = previous_frame ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit;
    tracers.run(graph, graph.compute("simple_ssr/trace.comp").read(shown.as("shown_lit")).write(traced), {"tracer"},
                tracers.images(graph, gbuffer.depth), ray_probe, draw.is("mirror") ? 1 : rays);
    if (!blurs() || is_sharp_) return {traced, traced, 3};
    const Image blurred = simple_blur(graph, traced);
    return {blurred, blurred, 3};
}

bool SimpleSsr::depends_on_seed() const { return !draw.is("mirror") || tracers.needs().random; }

TracingVariant::Needless SimpleSsr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness", .stages = {"simple_ssr/trace"}};
    needless.rays = !facts.has_reflective || facts.min_roughness > max_roughness;
    if (tracers.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (previous_frame) needless.stages.insert(needless.stages.begin(), "common/keep_lit");
    is_sharp_ = facts.max_roughness == 0;
    if (blurs())
        for (const char* stage : {"simple_ssr/blur_rows", "simple_ssr/blur_columns"}) {
            needless.stages.push_back(stage);
            if (is_sharp_)
                needless.parts.push_back(
                    {stage, "all that reflects is a mirror", "of mirrors it is no pixel wide", "", false});
        }
    needless.specular_readers = {"simple_ssr/trace"};
    if (blurs() && !is_sharp_) {
        needless.specular_readers.push_back("simple_ssr/blur_rows");
        needless.specular_readers.push_back("simple_ssr/blur_columns");
    }
    if (previous_frame) needless.motion_readers = {"simple_ssr/trace"};
    return needless;
}

VariantEntry simple_ssr_entry() {
    const nlohmann::json article_march = {{"tracer", "hzb"},
                                          {"hzb.at_coarsest", "linear"},
                                          {"hzb.guard_zero_direction", false},
                                          {"hzb.scale_step", false},
                                          {"hzb.near_plane_for_partial_texels", false},
                                          {"hzb.reject_own_surface", false},
                                          {"hzb.reject_background", false},
                                          {"hzb.front_faces_only", false},
                                          {"previous_frame", true}};
    return {
        .name = "simple_ssr",
        .title = "The simple techniques: mirror rays, uniformly blurred ones, jittered ones without reuse",
        .source =
            "introduction of Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, as quoted by others; the "
            "blog "
            "article 'Screen Space Ray Reflection' (2023)",
        .description =
            "A few rays per pixel, drawn by one of five rules, marched by any tracer, shown as their mean, with or "
            "without a "
            "blur of one size for near and far.",
        .presets =
            {{"slides_mirror",
              "mirror rays alone, steps in view space, the previous frame's colour",
              {{"previous_frame", true}}},
             {"slides_mirror_printed",
              "the same march as the notes print it, their inequality turned round: a step behind what is seen there "
              "is "
              "a hit, however far behind, from either side, and is not refined",
              {{"previous_frame", true},
               {"view_space.thickness", 1e6},
               {"view_space.front_faces_only", false},
               {"view_space.refinements", 0}}},
             {"slides_mirror_45",
              "the same, with no rays where the view is steeper than 45 degrees",
              {{"previous_frame", true}, {"rule_of_45_degrees", true}}},
             {"slides_blurred",
              "mirror rays, then a uniform blur by roughness, as in Killzone Shadow Fall; its width is ssrlab's",
              {{"previous_frame", true}, {"blur_width", 0.04}}},
             {"slides_jittered",
              "one ray per pixel about the mirror direction, averaged with nothing",
              {{"previous_frame", true}, {"draw", "jittered_ray"}, {"weights", "none"}}},
             {"cosine",
              "cosine-distributed directions, independent of the lobe: the baseline of importance sampling",
              {{"draw", "cosine"}, {"rays", 4}, {"tracer", "cells"}}},
             {"blog", "the article as printed: mirror rays through a hierarchical depth buffer", article_march},
             {"blog_importance", "the article as printed, with its other choice: a direction by importance",
              changed(article_march, {{"draw", "normals"}, {"weights", "none"}})},
             {"blog_corrected",
              "the article's march without the defects that README.md lists, for a mirror",
              {{"tracer", "hzb"}, {"previous_frame", true}, {"repair_inputs", true}}},
             {"corrected",
              "what these parts do best without a filter: four rays of visible normals, through cells of a pyramid, in "
              "this frame's colour",
              {{"draw", "visible_normals"},
               {"rays", 4},
               {"tracer", "cells"},
               {"cells.relative_thickness", 0.01},
               {"cells.thickness", 0.0},
               {"repair_inputs", true}}}},
        .create = [] { return std::make_unique<SimpleSsr>(); },
    };
}
