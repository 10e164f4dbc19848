#pragma once
#include "core/parameters.h"

/// Parameters of the ratio accumulation, in which a ray counts as much as the density of the pixel's own lobe is over
/// that with which it was drawn: its ratio. A pixel's own ray has a ratio near 1, a mirror's neighbours near 0.
struct RatioAccumulationParameters {
    ParameterSet& params;

    // clang-format off
    Switch reuse_neighbors{params, "reuse_neighbors", true,
        {"", "counts the rays of two traced pixels beside the pixel's own, other ones every frame", "ssrlab, to measure the stage"}};
    Param<float> least_ratio{params, "least_ratio", 0.01f, {0.0f, 1.0f},
        {"", "added to ratios: it decides where no ray suits the lobe, until one does", "ssrlab"}};
    Switch rough_from_probe{params, "rough_from_probe", false,
        {"", "surfaces rougher than max_roughness show what the screen says of their surroundings", "ssrlab"}};

    // History.
    Switch temporal_accumulation{params, "temporal_accumulation", true,
        {"", "counts the rays of the frames before", "ssrlab, to measure the stage"}};
    Param<float> max_history{params, "max_history", 160.0f, {1.0f, 65536.0f},
        {"rays of ratio 1", "that all the frames before count as, at most", "ssrlab"}};
    Param<float> moving_history{params, "moving_history", 1.0f, {0.0f, 65536.0f},
        {"rays of ratio 1", "the same for mirrors whose image moves on the screen; for rough surfaces more, in proportion up to "
         "surface_roughness", "ssrlab"}};
    Param<float> surface_roughness{params, "surface_roughness", 0.6f, {0.001f, 1.0f},
        {"perceptual", "from which on history is looked for where the surface was, below where its mirror image was", "ssrlab"}};
    Param<float> parallax_of_roughness{params, "parallax_of_roughness", 20.0f, {0.0f, 65536.0f},
        {"pixels per perceptual roughness", "beside one pixel, of parallax between what was reflected and what is, for half of the history", "ssrlab"}};
    Param<float> moved_pixels{params, "moved_pixels", 0.2f, {0.001f, 1e6f},
        {"pixels", "that what a ray met moves in a frame beside the camera's motion, for half of the history", "ssrlab; after "
         "Unity HDRP, speed of target"}};
    Param<float> change_deviations{params, "change_deviations", 2.0f, {0.0f, 1e6f},
        {"standard deviations", "of a mean over few frames that the luminance of history may lie from it, beyond which it is moved; "
         "0: any number", "ssrlab; after the fast history of Zhdan 2021, ReBLUR (Ray Tracing Gems II, chapter 49)"}};
    Param<float> change_frames{params, "change_frames", 4.0f, {1.0f, 64.0f},
        {"frames", "of the mean over few; for mirrors one", "ssrlab"}};
    // clang-format on
};
