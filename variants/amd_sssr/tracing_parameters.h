#pragma once
#include "variants/common/inward_rays.h"

/// Parameters of pyramid, classification, noise and intersection, under the original's names. "SSSR 1.5" is the effect
/// in FidelityFX SDK 1.1.4; its defaults are those of AMD's sample. Switches under "corrections" mend one defect each.
struct AmdTracingParameters {
    ParameterSet& params;

    // clang-format off
    Param<unsigned> samples_per_quad{params, "samples_per_quad", 1, {1, 4},
        {"rays", "rays that each 2x2 pixels start at least: 1, 2 or 4; 3 counts as 4", "SSSR 1.5, samplesPerQuad"},
        Use::constant};
    Switch guided_tracing{params, "guided_tracing", true,
        {"", "pixels whose variance of the last frame exceeds variance_threshold trace rays of their own",
         "SSSR 1.5, temporalVarianceGuidedTracingEnabled"}};
    Param<float> variance_threshold{params, "variance_threshold", 0.0f, {0.0f, 1.0f},
        {"squared relative change of luminance", "exceeded by pixels that trace rays of their own",
         "SSSR 1.5, varianceThreshold; at its default of 0 nearly every pixel traces from the second frame on"}};
    Param<float> roughness_threshold_alpha{params, "roughness_threshold_alpha", 0.2f, {0.0f, 1.0f},
        {"alpha", "GGX alpha (squared perceptual roughness) from which surfaces are left to the prefiltered "
         "environment", "SSSR 1.5, roughnessThreshold"}};
    Param<unsigned> max_traversal_intersections{params, "max_traversal_intersections", 128, {0, 4096},
        {"steps", "texels of the depth pyramid that one ray may visit", "SSSR 1.5, maxTraversalIntersections"}};
    Param<unsigned> min_traversal_occupancy{params, "min_traversal_occupancy", 4, {0, 128},
        {"lanes", "a subgroup with at most this many rays left gives them up, so the result depends on its size; "
         "0: none are", "SSSR 1.5, minTraversalOccupancy"}, Use::constant};
    Param<unsigned> most_detailed_mip{params, "most_detailed_mip", 0, {0, 5},
        {"mip", "finest level of the depth pyramid for all but mirrors, which use 0", "SSSR 1.5, mostDetailedMip"}};
    Param<float> depth_buffer_thickness{params, "depth_buffer_thickness", 0.015f, {1e-6f, 1e6f},
        {"m", "distance between ray and surface at which the confidence of a hit has fallen to 0",
         "SSSR 1.5, depthBufferThickness"}};
    Param<float> ibl_factor{params, "ibl_factor", 1.0f, {0.0f, 1e3f},
        {"", "multiplies the environment where a ray finds nothing", "SSSR 1.5, iblFactor"}};
    Param<unsigned> pyramid_mips{params, "pyramid_mips", 7, {2, 13},
        {"mips", "levels of the depth pyramid, the full resolution included; as many as the image has, at most",
         "SSSR 1.5: 7; version 1.3 builds the whole chain"}};
    Switch draw_directions{params, "draw_directions", true,
        {"", "draws each ray's direction from the lobe; otherwise it is the mirror's", "ssrlab, to measure the stage"}};
    Choice march{params, "march", "sdk", {"sdk", "slides", "none"},
        {"", "how t is computed where a ray meets a plane. sdk: plane / d - origin / d, compared bit by bit; slides: "
         "(plane - origin) / d, compared as floats; variants/amd_sssr/README.md says what else the slides "
         "print, and why it changes nothing. none: rays are not marched, and all miss, to measure the stage",
         "SSSR 1.5, ffx_sssr.h; slides of 2020, 'Stochastic Screen Space Reflections', traversal loop; none: ssrlab"}};
    Choice misses{params, "misses", "fallback", {"weight", "fallback"},
        {"", "what a ray without a hit contributes, and the share that a hit's confidence leaves. weight: only less "
         "confidence, which here takes what the composite fills in for it, the pixel's own fallback, through the denoiser; "
         "fallback: the environment in the ray's direction", "SSSR 1.5: fallback; weight: DiligentFX"}};

    Switch count_steps{params, "count_steps", false,
        {"", "keeps for each pixel that traces how many texels of the pyramid its march read, in the image `march_steps`; "
         "changes nothing else", "ssrlab, to measure the march"}};

    // Corrections.
    Switch thickness_at_hit_mip{params, "thickness_at_hit_mip", false,
        {"", "measures thickness and background against the level that the march ended on. The original takes the "
         "nearest of 2x2 pixels, so that confidence is lost wherever depth varies", "ssrlab; SSSR 1.5 reads mip 1"}};
    Switch independent_noise_shifts{params, "independent_noise_shifts", false,
        {"", "shifts the two random numbers by different irrationals every frame, in 32 bits. The original shifts "
         "both by the golden ratio, so that a pixel's samples stay on one diagonal of the unit square and never "
         "cover the lobe", "ssrlab; Roberts 2018, 'The Unreasonable Effectiveness of Quasirandom Sequences'"}};
    Switch trace_orphans{params, "trace_orphans", false,
        {"", "a pixel that waits for the ray of a quad neighbour which traces none traces its own. In the original it "
         "stays black: dark contours where a quad's first pixel is sky, rough or of another surface", "ssrlab"}};
    Switch clip_ray_to_near_plane{params, "clip_ray_to_near_plane", false,
        {"", "shortens the unit step that gives the ray's direction on the screen so that it stays before the near "
         "plane; behind the camera it would be mirrored", "ssrlab"}};
    Switch guard_zero_direction{params, "guard_zero_direction", false,
        {"", "a ray along a screen axis divides by a number that is not 0; in the original's GLSL the guard only "
         "works if all three components are 0", "ssrlab; AMD's hybrid reflections sample guards each component"}};
    Switch guard_mirror_normal{params, "guard_mirror_normal", false,
        {"", "mirrors reflect about the shading normal itself. The original samples a lobe of width 0, which is not a "
         "number where the random number rounds to 1", "ssrlab"}};
    Switch redraw_below_horizon{params, "redraw_below_horizon", false,
        {"", "draws directions until one is above the horizon of the shading normal. The original takes the first",
         "Eto and Tokuyoshi 2023, 'Bounded VNDF Sampling for Smith-GGX Reflections'; as the path-traced reference"}};
    Choice inward_rays = inward_rays_parameter(params, "traced", "SSSR 1.5: traced; black: as the path-traced reference");
    Switch stop_outside_screen{params, "stop_outside_screen", false,
        {"", "ends a ray where it leaves the screen", "ssrlab; AMD's hybrid reflections sample does"}};
    Switch refine_partial_texels{params, "refine_partial_texels", false,
        {"", "texels of the screen that odd-sized levels lack are looked up a level finer. The original reads 0 there: "
         "with reversed depth whole strips at the lower and right edge are skipped", "ssrlab"}};
    Switch reject_unfinished{params, "reject_unfinished", false,
        {"", "a ray that ran out of steps, or was given up by its subgroup, is a miss. The original validates "
         "wherever it stood", "ssrlab"}};
    Switch accept_contact_hits{params, "accept_contact_hits", false,
        {"", "rejects a hit only in the pixel that its ray started from. The original rejects those nearer than "
         "two pixels on both axes, so that contact reflections show the environment", "ssrlab"}};
    Switch far_misses{params, "far_misses", false,
        {"", "a ray that misses is as long as the far plane is away. The original stores the length to wherever it was "
         "given up, and the denoiser reprojects the environment from there", "ssrlab"}};
    Switch rate_stored_roughness{params, "rate_stored_roughness", false,
        {"", "classification rates pixels by alpha as the passes after it read it, rounded to 8 bits. The original rates "
         "them by what is not rounded yet: an alpha between 0.198 and 0.2 is traced and never denoised, one below 0.002 "
         "is rated as glossy here and as a mirror there", "ssrlab"}};
    Switch float_roughness{params, "float_roughness", false,
        {"", "keeps alpha in 32 bits, by which all passes then rate pixels; in 8 bits widths differ from the surface's by "
         "up to 0.002", "ssrlab; SSSR 1.5 stores R8_UNORM"}};
    // clang-format on
};
