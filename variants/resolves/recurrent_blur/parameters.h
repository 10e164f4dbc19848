#pragma once
#include "core/parameters.h"

/// Parameters of the recurrent blur. "three.js" is RecurrentDenoiseNode.js and TemporalReprojectNode.js of its
/// examples/jsm/tsl/display at commit 011d3c8d (MIT licence), with the values of its example of denoised reflections,
/// where the classes have others; it follows NVIDIA's REBLUR (Zhdan 2021, "ReBLUR: A Hierarchical Recurrent Denoiser",
/// Ray Tracing Gems II). Switches under "corrections" fix one defect each.
struct RecurrentBlurParameters {
    ParameterSet& params;

    // clang-format off
    // Where history is.
    Switch temporal_accumulation{params, "temporal_accumulation", true,
        {"", "blends with history", "ssrlab, to measure the stage"}};
    Param<float> max_frames{params, "max_frames", 16.0f, {1.0f, 1024.0f},
        {"frames", "longest history", "three.js, maxFrames; 32 in its class"}};
    Param<float> clamp_intensity{params, "clamp_intensity", 0.25f, {0.0f, 1.0f},
        {"", "share by which history is moved into the box of 3x3 neighbours' colours; more where it is stretched or its mirror image "
         "is uncertain, less where nothing moves", "three.js, clampIntensity; 1 in its class"}};
    Param<float> flicker_suppression{params, "flicker_suppression", 1.0f, {0.0f, 10.0f},
        {"W^-1 sr m^2", "a tenth of what luminance takes from a colour's weight where colours are compared and where history and the new "
         "ones are blended, which darkens", "three.js, flickerSuppression"}};

    // The blur.
    Switch spatial_filter{params, "spatial_filter", true,
        {"", "blurs; otherwise each pixel's own history and rays are blended", "ssrlab, to measure the stage"}};
    Param<float> radius{params, "radius", 1.5f, {0.0f, 100.0f},
        {"", "ten times the radius of the disk in a pixel without history, over the length of its rays, their distance (m) and the square "
         "root of the roughness", "three.js, radius; 5 in its class"}};
    Param<float> strength{params, "strength", 0.725f, {0.0f, 1.0f},
        {"", "how far the radius stays when history grows: it falls with its length to the power of 1 - strength, to a twentieth",
         "three.js, strength; 0.25 in its class"}};
    Param<float> adapt{params, "adapt", 0.5f, {0.0f, 1.0f},
        {"", "how much a neighbour that is refused draws the next ones nearer, and towards those that are not", "three.js, adapt"}};
    Param<float> luma_phi{params, "luma_phi", 0.75f, {0.0f, 100.0f},
        {"W^-1 sr m^2", "a tenth of how fast a neighbour's weight falls with the difference in luminance", "three.js, lumaPhi; 5 in its class"}};
    Param<float> depth_phi{params, "depth_phi", 20.0f, {0.0f, 1000.0f},
        {"", "how fast, times 500, it falls with the distance from the pixel's plane over that from the camera",
         "three.js, depthPhi; 5 in its class"}};
    Param<float> normal_phi{params, "normal_phi", 0.3f, {0.0f, 1.0f},
        {"", "narrows the cone of normals that count", "three.js, normalPhi; 5 in its class, which its formula does not hold"}};
    Param<float> length_phi{params, "length_phi", 5.0f, {0.0f, 100.0f},
        {"m", "how fast it falls with the difference in the length of rays, over the height of the view there and the pixel's distance",
         "three.js, alphaPhi; 1 in its class"}};
    Param<float> roughness_phi{params, "roughness_phi", 100.0f, {0.0f, 1000.0f},
        {"1 / perceptual roughness", "how fast it falls with the difference in roughness", "three.js, roughnessPhi"}};
    Switch smooth_disocclusions{params, "smooth_disocclusions", true,
        {"", "a pixel counts as younger where its neighbours are", "three.js, smoothDisocclusions"}};
    Param<float> adaptive_trust{params, "adaptive_trust", 1.0f, {0.0f, 1.0f},
        {"", "gives history more weight where the luminances of a pixel and its four neighbours scatter", "three.js, adaptiveTrust; 0 in its class"}};
    Switch damp_fireflies{params, "damp_fireflies", true,
        {"", "in the first five frames bright neighbours count less, by the square of their luminance, which darkens", "three.js"}};

    // Corrections.
    Switch scale_free{params, "scale_free", false,
        {"", "lengths count over the distance from the camera, and differences of colours over the colours, so that neither unit decides. The "
         "original multiplies the radius by the distance, takes a ray that meets nothing for 0.25 m long, and compares colours and lengths as numbers",
         "ssrlab"}};
    Switch reproject_misses{params, "reproject_misses", false,
        {"", "what rays without a hit see is looked for in history where a mirror shows something infinitely far away. The original "
         "moves it with the surface", "ssrlab"}};
    // clang-format on
};
