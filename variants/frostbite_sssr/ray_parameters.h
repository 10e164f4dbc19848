#pragma once
#include "variants/resolves/ray_draw.h"
#include "variants/tracers/tracers.h"

/// Parameters of classification, sampling and tracing; "slides" as in ray_draw.h.
struct FrostbiteRayParameters : RayDrawParameters {
    // clang-format off
    // Rays per tile.
    Switch classification{params, "classification", true,
        {"", "a probe ray per 8x8 pixels decides how many rays each tile of 32x32 pixels gets; otherwise all tiles get "
         "max_rays", "slides: probes at 1/8 resolution; the size of a tile is ours"}};
    Param<unsigned> min_rays{params, "min_rays", 1, {1, 4},
        {"rays", "of each traced pixel in a tile whose probes agree, but at most max_rays", "ssrlab"}, Use::constant};
    Choice rays_by{params, "rays_by", "deviation", {"deviation", "hit_ratio", "product"},
        {"", "how far from min_rays to max_rays a tile is. deviation: of its probes' compressed luminance, over variance_scale; "
         "hit_ratio: the share of its probes that hit; product: of both",
         "slides: the ratio of hits and how much they differ; how these make a number is ours"}};
    Param<float> variance_scale{params, "variance_scale", 0.5f, {1e-3f, 1e3f},
        {"of the mean", "standard deviation of the probes' compressed luminance that counts as 1", "ssrlab"}};
    Switch dilate_tiles{params, "dilate_tiles", true,
        {"", "a tile is skipped only if its eight neighbours' probes miss, too; probes alone overlook thin objects, and "
         "tiles pop", "ssrlab"}};
    Param<unsigned> hysteresis{params, "hysteresis", 4, {0, 255},
        {"frames", "for which a tile keeps its rays after its probes last hit", "ssrlab"}};

    // The two tracers.
    Param<float> rough_from{params, "rough_from", 0.2f, {0.0f, 1.0f},
        {"perceptual", "roughness from which rays are traced by `rough_tracer`; those of smoother surfaces by `tracer`",
         "slides: 20 %, of which roughness they do not say"}};
    // clang-format on

    Tracers tracers{params,
                    {{"tracer", "smooth_trace", "frostbite_hierarchical", "the march of smooth surfaces' rays"},
                     {"rough_tracer", "rough_trace", "frostbite_linear", "the march of rough surfaces' rays"}},
                    "slides: through a depth pyramid, and in linear steps"};
};
