#pragma once
#include "variants/common/blue_noise.h"
#include "variants/common/inward_rays.h"
#include "variants/tracers/tracers.h"

/// Parameters of depth hierarchy, mask, noise and intersection, under the original's names; those of its march begin
/// with `hierarchy.`. "DiligentFX" is its ScreenSpaceReflection as of July 2026, "2024" that of April 2024, which its
/// document describes. Switches under "corrections" fix one defect each.
struct DiligentTracingParameters {
    ParameterSet& params;

    // clang-format off
    Choice mask{params, "mask", "depth", {"depth", "stencil"},
        {"", "the hardware test that leaves out pixels which reflect nothing: a depth buffer of 16 bits, or the stencil "
         "buffer", "DiligentFX; stencil until January 2025"}};
    Choice hierarchy{params, "hierarchy", "intermediate", {"intermediate", "mip_views"},
        {"", "how a level of the depth hierarchy is made from the level below. intermediate: each finished level is copied "
         "to a second image, from which the next one is drawn, as WebGL 2 needs; mip_views: one level is drawn while "
         "another of the same image is read, which lifts the limits of WebGL 2", "DiligentFX"}};
    Switch half_resolution{params, "half_resolution", false,
        {"", "traces one ray per 2x2 pixels", "DiligentFX, FEATURE_FLAG_HALF_RESOLUTION"}};
    Switch previous_frame{params, "previous_frame", false,
        {"", "hits take their colour from the previous frame's lit image, where they were then",
         "DiligentFX, FEATURE_FLAG_PREVIOUS_FRAME"}};
    Param<float> roughness_threshold{params, "roughness_threshold", 0.2f, {0.0f, 1.0f},
        {"perceptual", "rougher surfaces are left to the fallback", "DiligentFX, RoughnessThreshold"}};
    Choice misses{params, "misses", "weight", {"weight", "fallback"},
        {"", "what a ray without a hit contributes, and the share that a hit's confidence leaves. weight: only less "
         "confidence; fallback: the environment in the ray's direction", "DiligentFX: weight; fallback: SSSR 1.5"}};
    Param<float> ggx_importance_sample_bias{params, "ggx_importance_sample_bias", 0.3f, {0.0f, 1.0f},
        {"of the lobe", "share of the sampled visible normals that is cut off, those furthest from the view direction. 0 is further from the "
         "truth than 0.3; more is less noisy on average, not in every scene (README.md)",
         "DiligentFX, GGXImportanceSampleBias"}};

    Switch roughness_perceptual{params, "roughness_perceptual", true,
        {"", "takes the G-buffer's roughness for what it is. Off, it is taken for alpha, as where an application sets the flag "
         "wrongly", "DiligentFX, IsRoughnessPerceptual"}};
    Choice half_vectors{params, "half_vectors", "caps", {"caps", "disk", "normals"},
        {"", "how normals are drawn, about which the view is mirrored. caps: visible ones, by spherical caps; disk: the same ones by a "
         "disk, so that other random numbers give them; normals: of the distribution of all normals, many of which the "
         "viewer does not see; of the latter two ggx_importance_sample_bias cuts the rim of the disk and the widest angles, and "
         "bias_towards_mirror changes nothing", "DiligentFX: caps; its document names the disk (Heitz 2018) and what came before it"}};
    Choice noise = noise_parameter(params, "blue: DiligentFX's document, which shows both");

    // Corrections.
    Switch bias_towards_mirror{params, "bias_towards_mirror", false,
        {"", "moves the part of the lobe that ggx_importance_sample_bias leaves towards the mirror direction, which a "
         "bias of 1 then gives. The original moves it towards the view direction, and its rays with it", "ssrlab"}};
    Choice inward_rays = inward_rays_parameter(params, "traced", "DiligentFX: traced");
    Switch independent_noise_shifts = independent_noise_shifts_parameter(params);
    Switch float_roughness{params, "float_roughness", false,
        {"", "keeps the roughness that is extracted with the mask in 32 bits in place of 8", "ssrlab; DiligentFX stores R8_UNORM"}};
    Switch float_rays{params, "float_rays", false,
        {"", "keeps colour, direction, length and density of rays in 32 bits in place of 16, in which lengths and densities "
         "saturate at 65504", "ssrlab; DiligentFX stores RGBA16F"}};
    Switch premultiply_confidence{params, "premultiply_confidence", false,
        {"", "weights the colour of a ray with its confidence before the filters, and divides by the filtered confidence "
         "after them. The original averages misses as black and then multiplies by the confidence once more, so that "
         "edges of reflections are dark", "ssrlab"}};
    // clang-format on

    Tracers tracers{params,
                    {{"tracer", "trace", "hierarchy", "the march that finds what a ray meets"}},
                    "DiligentFX: hierarchy",
                    {{"hierarchy.accept_contact_hits", false},
                     {"hierarchy.reject_unfinished", false},
                     {"hierarchy.finite_length", false},
                     {"hierarchy.stop_outside_screen", false},
                     {"hierarchy.max_traversal_intersections", 128},
                     {"hierarchy.clip_ray_to_near_plane", false},
                     {"hierarchy.relative_ray_step", false},
                     {"hierarchy.partial_texels", "zero"},
                     {"hierarchy.unproject_jitter", false}}};
};
