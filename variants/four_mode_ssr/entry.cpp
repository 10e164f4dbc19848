#include "variants/common/variant_entry.h"
#include "variants/four_mode_ssr/four_mode_ssr.h"

namespace {

/// A row of the document's table "Quality Presets".
nlohmann::json quality(unsigned max_steps, unsigned binary_search_steps, double stride, unsigned num_rays) {
    return {{"fixed_stride.max_steps", max_steps},
            {"cells.max_steps", max_steps},
            {"fixed_stride.binary_search_steps", binary_search_steps},
            {"fixed_stride.stride", stride},
            {"num_rays", num_rays}};
}

/// Corrections of the march, the mean and the temporal mode's history.
nlohmann::json corrections() {
    nlohmann::json parameters = {{"fixed_stride.step", "pixels"},
                                 {"fixed_stride.reject_towards_camera", false},
                                 {"fixed_stride.front_faces_only", true},
                                 {"cells.interval", true},
                                 {"cells.back_faces", "reject"},
                                 {"cells.grazing_fade", 0},
                                 {"weights", "ratio"},
                                 {"brdf_bias", 1},
                                 {"history_place", "motion_vectors"},
                                 {"reject_other_surfaces", true},
                                 {"weigh_by_confidence", true},
                                 {"repair_inputs", true}};
    for (const std::string march : {"fixed_stride", "cells"})
        parameters.update({{march + ".max_steps", 16384},
                           {march + ".max_distance", 0},
                           {march + ".thickness", 0},
                           {march + ".relative_thickness", 0.01},
                           {march + ".sky_depth", 0},
                           {march + ".clip_to_near_plane", true},
                           {march + ".edge_fade", false},
                           {march + ".distance_fade", false}});
    return parameters;
}

}  // namespace

VariantEntry four_mode_ssr_entry() {
    return {
        .name = "four_mode_ssr",
        .title = "An engine's reflection pass of four modes",
        .source = "documentation of an engine's screen-space reflections (2026-01-14)",
        .description =
            "A fixed stride, a march through a depth pyramid, several rays of the GGX lobe, or these blended over "
            "time; with "
            "the document's fades, and its composite as a study's option.",
        .presets = {{"low", "the document's table: 32 steps, 4 of refinement, stride 2, 1 ray", quality(32, 4, 2, 1)},
                    {"medium", "48 steps, 6 of refinement, stride 1.5, 2 rays", quality(48, 6, 1.5, 2)},
                    {"high", "64 steps, 8 of refinement, stride 1, 4 rays: the document's default",
                     quality(64, 8, 1, 4)},
                    {"ultra", "96 steps, 12 of refinement, stride 0.5, 8 rays", quality(96, 12, 0.5, 8)},
                    {"custom", "all of it user-defined: the defaults, which are those of the document's settings",
                     nlohmann::json::object()},
                    {"corrected", "marches and means without the defects that README.md lists, in any mode",
                     corrections()}},
        .create = [] { return std::make_unique<FourModeSsr>(); },
    };
}
