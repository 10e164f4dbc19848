#include "variants/common/variant_entry.h"
#include "variants/frostbite_sssr/frostbite_sssr.h"

VariantEntry frostbite_sssr_entry() {
    return {
        .name = "frostbite_sssr",
        .title = "Frostbite's stochastic screen-space reflections, with ray reuse",
        .source =
            "Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, SIGGRAPH course Advances in Real-Time "
            "Rendering, as quoted by others; gaps are filled by ssrlab",
        .description =
            "Probes decide how many rays each tile gets; a hierarchical march serves smooth surfaces and linear steps "
            "rough ones; each pixel weighs its neighbours' rays by its own BRDF, takes their colours from mip levels, "
            "and blends with its reflection of the previous frame.",
        .presets =
            {{"frostbite_2015",
              "the configuration whose times were published: 1 ray per half-resolution pixel, 4 taps, 0.7 of the "
              "lobe cut off, estimator a; where nothing was published, our defaults",
              nlohmann::json::object()},
             {"one_ray_one_tap",
              "the same without reuse: each pixel shows its own half-resolution pixel's ray (not published)",
              {{"taps", "1"}}},
             {"four_rays_one_tap",
              "the published comparison, which takes twice as long and looks worse: 4 rays per half-resolution "
              "pixel in place of reuse",
              {{"min_rays", 4}, {"max_rays", 4}, {"taps", "1"}}},
             {"best",
              "the least error that a search found (search_frostbite.json of commit 5cf9fef): one ray per pixel from "
              "0.7 of the "
              "lobe of visible normals; hits that the previous frame did not show use the environment",
              {{"half_resolution", false},
               {"lobe", "visible_normals"},
               {"importance_bias", 0.3},
               {"frostbite.relative_thickness", 0.02},
               {"hidden_hits", "miss"},
               {"cone_scale", 0.5},
               {"pattern", "interleaved"},
               {"clamp_scale", 1.0},
               {"repair_inputs", true}}}},
        .create = [] { return std::make_unique<FrostbiteSssr>(); },
    };
}
