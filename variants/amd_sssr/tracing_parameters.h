#pragma once
#include "variants/common/blue_noise.h"
#include "variants/common/inward_rays.h"
#include "variants/tracers/tracers.h"

/// Parameters of classification, noise and intersection, under the original's names; those of its march begin with
/// `hierarchy.`. "SSSR 1.5" is the effect in FidelityFX SDK 1.1.4; its defaults are those of AMD's sample. Switches
/// under "corrections" fix one defect each.
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
    Param<float> ibl_factor{params, "ibl_factor", 1.0f, {0.0f, 1e3f},
        {"", "multiplies the environment where a ray finds nothing", "SSSR 1.5, iblFactor"}};
    Switch draw_directions{params, "draw_directions", true,
        {"", "draws each ray's direction from the lobe; otherwise it is the mirror's", "ssrlab, to measure the stage"}};
    Choice jitter{params, "jitter", "normal", {"normal", "ray"},
        {"", "what is drawn at random. normal: one of the normals that the viewer sees, about which the view is mirrored; ray: a "
         "direction about the mirror's, of the lobe that a view along the normal has", "AMD's slides show both; SSSR 1.5: normal"}};
    Choice noise = noise_parameter(params, "blue: AMD's slides");
    Choice misses{params, "misses", "fallback", {"weight", "fallback"},
        {"", "what a ray without a hit contributes, and the share that a hit's confidence leaves. weight: only less "
         "confidence, which here takes what the composite fills in for it, the pixel's own fallback, through the denoiser; "
         "fallback: the environment in the ray's direction", "SSSR 1.5: fallback; weight: DiligentFX"}};

    // Corrections.
    Switch independent_noise_shifts = independent_noise_shifts_parameter(params);
    Switch trace_orphans{params, "trace_orphans", false,
        {"", "a pixel that waits for the ray of a quad neighbour which traces none traces its own. In the original it "
         "stays black: dark contours where a quad's first pixel is sky, rough or of another surface", "ssrlab"}};
    Switch guard_mirror_normal{params, "guard_mirror_normal", false,
        {"", "mirrors reflect about the shading normal itself. The original samples a lobe of width 0, which is not a "
         "number where the random number rounds to 1", "ssrlab"}};
    Switch redraw_below_horizon{params, "redraw_below_horizon", false,
        {"", "draws directions until one is above the horizon of the shading normal. The original takes the first",
         "Eto and Tokuyoshi 2023, 'Bounded VNDF Sampling for Smith-GGX Reflections'; as the path-traced reference"}};
    Choice inward_rays = inward_rays_parameter(params, "traced", "SSSR 1.5: traced; black: as the path-traced reference");
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

    Tracers tracers{params,
                    {{"tracer", "trace", "hierarchy", "the march that finds what a ray meets"}},
                    "SSSR 1.5: hierarchy",
                    {{"hierarchy.judgement", "amd"},
                     {"hierarchy.thickness_at_hit_mip", false},
                     {"hierarchy.accept_contact_hits", false},
                     {"hierarchy.reject_unfinished", false},
                     {"hierarchy.finite_length", false},
                     {"hierarchy.stop_outside_screen", false},
                     {"hierarchy.max_traversal_intersections", 128},
                     {"hierarchy.min_traversal_occupancy", 4},
                     {"hierarchy.zero_direction", "whole_vector"},
                     {"hierarchy.clip_ray_to_near_plane", false},
                     {"hierarchy.relative_ray_step", false},
                     {"hierarchy.partial_texels", "zero"}}};
};
