#include "variants/common/variant_entry.h"
#include "variants/simple_ssr/simple_ssr.h"

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
