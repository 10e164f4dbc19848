#include "variants/common/variant_entry.h"
#include "variants/mcguire_dda/mcguire_dda.h"

VariantEntry mcguire_dda_entry() {
    return {
        .name = "mcguire_dda",
        .title = "Screen-space ray tracing by a perspective-correct DDA",
        .source = "McGuire & Mara 2014, Efficient GPU Screen-Space Ray Tracing, JCGT 3(4)",
        .description =
            "One mirror ray per pixel, walked pixel by pixel along its line on the screen until it passes "
            "behind a surface.",
        .presets = {{"published",
                     "the first interval starts at the ray's origin, as in the paper",
                     {{"dda.interval_from_origin", true}}},
                    {"coarse",
                     "every fourth pixel, dithered, with the authors' refinement",
                     {{"dda.stride", 4}, {"dda.checkerboard", true}, {"dda.refine", true}}},
                    {"any_scale",
                     "thickness as a share of the depth, for scenes of any size",
                     {{"dda.thickness", 0.0}, {"dda.relative_thickness", 0.02}}},
                    {"best",
                     "the least error that a search found (search_mcguire_dda.json of commit 5cf9fef)",
                     {{"bilinear_color", true},
                      {"dda.clip_to_viewport", false},
                      {"max_roughness", 0.2},
                      {"repair_inputs", true}}}},
        .create = [] { return std::make_unique<McGuireDda>(); },
    };
}
