#include "variants/tracers/tracer.h"

namespace {

struct Hierarchy final : Tracer {
    explicit Hierarchy(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.nearest_mips = pyramid_mips}; }

    std::string not_repeatable() const override {
        return min_traversal_occupancy == 0
                   ? ""
                   : "hierarchy.min_traversal_occupancy > 0: which rays share a subgroup depends "
                     "on the order in which threads ran";
    }

    // Names are the originals' where both have one. Techniques that are an original begin with its values; the defaults
    // are those with all defects fixed.
    // clang-format off
    Choice judgement{params, "hierarchy.judgement", "diligent", {"amd", "diligent"},
        {"", "how the place where the walk ended is judged. amd: by the distance between ray and surface in metres; "
         "diligent: by the same over the surface's distance from the camera plane", "SSSR 1.5; DiligentFX"}};
    Param<float> depth_buffer_thickness{params, "hierarchy.depth_buffer_thickness", 0.015f, {1e-6f, 1e6f},
        {"m", "distance between ray and surface at which the confidence of a hit has fallen to 0, by judgement amd",
         "SSSR 1.5, depthBufferThickness"}};
    Param<float> relative_depth_buffer_thickness{params, "hierarchy.relative_depth_buffer_thickness", 0.025f, {1e-6f, 1.0f},
        {"of the depth", "distance between ray and surface, over the surface's distance from the camera plane, at which "
         "the confidence of a hit has fallen to 0, by judgement diligent", "DiligentFX, DepthBufferThickness"}};
    Switch thickness_at_hit_mip{params, "hierarchy.thickness_at_hit_mip", true,
        {"", "measures thickness and background, by judgement amd, against the level that the walk ended on. The original "
         "takes the nearest of 2x2 pixels, so that confidence is lost wherever depth varies",
         "ssrlab; SSSR 1.5 reads mip 1"}};
    Switch fade_at_border{params, "hierarchy.fade_at_border", true,
        {"", "hits fade out over the outermost twentieth of the screen", "SSSR 1.5; DiligentFX"}};
    Switch accept_contact_hits{params, "hierarchy.accept_contact_hits", true,
        {"", "rejects a hit only in the pixel that its ray started from. The originals reject those nearer than two pixels "
         "on both axes, so that contact reflections are lost", "ssrlab"}};
    Switch reject_unfinished{params, "hierarchy.reject_unfinished", true,
        {"", "a ray that ran out of steps, or was given up by its subgroup, is a miss. The originals validate wherever it "
         "stood", "ssrlab"}};
    Switch stop_outside_screen{params, "hierarchy.stop_outside_screen", true,
        {"", "ends a ray where it leaves the screen", "ssrlab; AMD's hybrid reflections sample does"}};
    Switch finite_length{params, "hierarchy.finite_length", true,
        {"", "a ray that ended where positions have no end, at the far plane and beyond, is as long as four times that plane's "
         "distance. The originals store infinity and what comes of it", "ssrlab"}};
    Param<unsigned> max_traversal_intersections{params, "hierarchy.max_traversal_intersections", 4096, {0, 4096},
        {"steps", "texels of the depth pyramid that one ray may visit",
         "SSSR 1.5, maxTraversalIntersections; DiligentFX, MaxTraversalIntersections; both 128"}};
    Param<unsigned> min_traversal_occupancy{params, "hierarchy.min_traversal_occupancy", 0, {0, 128},
        {"lanes", "a subgroup with at most this many rays left gives them up, so the result depends on its size; "
         "0, and in fragment shaders: none are", "SSSR 1.5, minTraversalOccupancy: 4"}, Use::constant};
    Param<unsigned> most_detailed_mip{params, "hierarchy.most_detailed_mip", 0, {0, 6},
        {"mip", "finest level of the depth pyramid for all but mirrors, which use 0",
         "SSSR 1.5, mostDetailedMip; DiligentFX, MostDetailedMip"}, Use::constant};
    Param<unsigned> pyramid_mips{params, "hierarchy.pyramid_mips", 7, {2, 13},
        {"mips", "levels of the depth pyramid, the full resolution included; as many as the image has, at most",
         "SSSR 1.5 and DiligentFX: 7; SSSR 1.3 builds the whole chain"}};
    Choice march{params, "hierarchy.march", "sdk", {"sdk", "slides", "none"},
        {"", "how t is computed where a ray meets a plane. sdk: plane / d - origin / d, compared bit by bit; slides: "
         "(plane - origin) / d, compared as floats; variants/amd_sssr/README.md says what else the slides print, and why it "
         "changes nothing. none: rays are not marched, and all miss, to measure the stage",
         "SSSR 1.5, ffx_sssr.h; slides of 2020, 'Stochastic Screen Space Reflections', traversal loop; none: ssrlab"}};
    Choice zero_direction{params, "hierarchy.zero_direction", "each_component", {"whole_vector", "nudged", "each_component"},
        {"", "what stands for the inverse of 0 in a ray along a screen axis. whole_vector: infinity, whose products are not "
         "numbers, unless all three components are 0; nudged: components below 1e-12 are 1e-12; each_component: the largest "
         "float", "whole_vector: SSSR 1.5 as GLSL; nudged: AMD's hybrid reflections sample; each_component: DiligentFX"}};
    Switch clip_ray_to_near_plane{params, "hierarchy.clip_ray_to_near_plane", true,
        {"", "shortens the step that gives the ray's direction on the screen so that it stays before the near plane; "
         "behind the camera it would be mirrored", "ssrlab"}};
    Switch relative_ray_step{params, "hierarchy.relative_ray_step", true,
        {"", "makes that step a share of the distance from the camera in place of one metre, which in large scenes is "
         "lost to rounding", "ssrlab"}};
    Choice partial_texels{params, "hierarchy.partial_texels", "near_plane", {"zero", "near_plane", "clamped"},
        {"", "what stands for texels of the screen that odd-sized levels lack. zero: 0, with which strips at the lower and "
         "right edge are skipped with reversed depth; near_plane: they are looked up a level finer; clamped: the last texel of "
         "the level, which a pyramid of DiligentFX made of three", "SSSR 1.5 and DiligentFX: zero; ssrlab"}};
    Switch unproject_jitter{params, "hierarchy.unproject_jitter", true,
        {"", "view-space positions undo the TAA jitter that the projection of the ray applies. In DiligentFX they differ, "
         "which turns every ray by an angle that grows with the distance", "SSSR 1.5; ssrlab"}};
    // clang-format on
};

}  // namespace

TracerEntry hierarchy_tracer() {
    return {.name = "hierarchy",
            .title = "Walk through a pyramid of nearest depths, of FidelityFX SSSR and DiligentFX",
            .source = "FidelityFX SDK 1.1.4 (SSSR 1.5), MIT licence; DiligentFX (2026-07), Apache-2.0 licence",
            .description =
                "Descends to the first surface that the ray falls behind, and judges by thickness whether it is "
                "what the ray met; it does not go on behind it.",
            .shader = "tracers/hierarchy/hierarchy.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<Hierarchy>(params); }};
}
