#include "variants/tracers/tracer.h"

namespace {

struct Hzb final : Tracer {
    explicit Hzb(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.nearest_mips = pyramid_mips}; }

    // clang-format off
    Param<unsigned> max_iterations{params, "hzb.max_iterations", 4096, {1, 65536},
        {"steps", "texels of the depth pyramid that one ray may visit before it counts as a miss",
         "the article, section 4.3, names no value; the default is ssrlab's"}};
    Param<unsigned> base_level{params, "hzb.base_level", 0, {0, 6},
        {"level", "of the depth pyramid, on which the walk begins and below which it has found its surface",
         "the article, section 4.3: 0"}};
    Param<unsigned> pyramid_mips{params, "hzb.pyramid_mips", 7, {2, 13},
        {"mips", "levels of the depth pyramid, the full resolution included; as many as the image has, at most",
         "the article, section 4.2.2, names no value; SSSR 1.5, from which it comes: 7"}};
    Choice at_coarsest{params, "hzb.at_coarsest", "linear", {"miss", "linear"},
        {"", "what becomes of a ray that would rise above the coarsest level. miss: it ends; linear: it goes on "
         "there, texel by texel", "the article, section 4.2.2, names both and prints linear"}};
    Param<float> relative_thickness{params, "hzb.relative_thickness", 0.025f, {1e-6f, 10.0f},
        {"of the depth", "distance between the depths of ray and surface, over the surface's, from which on the "
         "place where the walk ended is no hit",
         "the article, section 4.2.3, names no value; the default is DiligentFX's"}};
    Switch guard_zero_direction{params, "hzb.guard_zero_direction", true,
        {"", "gives rays along a row or column of the screen the largest float for the inverse of 0. As printed it "
         "is infinite, and their way no number", "ssrlab; the article, section 4.3, has no guard"}};
    Switch scale_step{params, "hzb.scale_step", true,
        {"", "makes the step whose projection gives the direction half as long as the distance from the camera "
         "plane. As printed it is one metre, whose end may lie behind the camera, from where it is projected to the "
         "opposite side; in large scenes it is lost to rounding", "ssrlab; the article, section 3, prints one unit"}};
    Switch walls_only_towards_camera{params, "hzb.walls_only_towards_camera", true,
        {"", "rays that come nearer stop at the walls of texels only: the depth of a surface behind them lies in "
         "their past, and the step to it goes back. The article's code does so; its general rule does not, and the "
         "section on such rays breaks off", "the article, sections 4.2 and 4.2.1"}};
    Switch near_plane_for_partial_texels{params, "hzb.near_plane_for_partial_texels", true,
        {"", "looks a level finer where odd-sized levels lack the last texel. Otherwise it is 0, as reads beyond an "
         "image are: with reversed depth strips at the lower and right edge are skipped",
         "ssrlab; the article halves sizes without rounding"}};
    Switch reject_own_surface{params, "hzb.reject_own_surface", true,
        {"", "a walk that ends in the pixel that it began in, or on the plane that it left, is a miss. As printed "
         "only the first step, out of that pixel, keeps rays from meeting themselves",
         "ssrlab; SSSR 1.5 has a rule like it"}};
    Switch reject_background{params, "hzb.reject_background", true,
        {"", "a walk that ends where nothing was drawn is a miss. As printed a ray that reaches the far plane there "
         "hits it", "SSSR 1.5; the article leaves the check out"}};
    Switch front_faces_only{params, "hzb.front_faces_only", true,
        {"", "a ray that meets a surface from behind counts as a miss: the screen shows the other side of it",
         "SSSR 1.5; the article leaves the check out"}};
    // clang-format on
};

}  // namespace

TracerEntry hzb_tracer() {
    return {.name = "hzb",
            .title = "March through a hierarchical depth buffer, in its shortest form",
            .source = "the blog article 'Screen Space Ray Reflection' (2023), after FidelityFX SSSR",
            .description =
                "Descends to the first surface that the ray falls behind, and takes it for what the ray met if "
                "their depths are alike.",
            .shader = "tracers/hzb/hzb.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<Hzb>(params); }};
}
