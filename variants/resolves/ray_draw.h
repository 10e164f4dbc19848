#pragma once
#include "core/parameters.h"

/// Which pixels start rays, how many, and in which directions: what a resolve must know of its rays. "Slides" are those
/// of Stachowiak and Uludag 2015, "Stochastic Screen-Space Reflections" (SIGGRAPH, Advances in Real-Time Rendering), as
/// quoted by others: what they leave open is ours and says so.
struct RayDrawParameters {
    ParameterSet& params;

    // clang-format off
    Switch half_resolution{params, "half_resolution", true,
        {"", "starts rays in one of each 2x2 pixels, another one every frame; otherwise in every pixel", "slides, resolve; "
         "that the pixel changes is ours"}};
    Param<float> max_roughness{params, "max_roughness", 0.6f, {0.0f, 1.0f},
        {"perceptual", "rougher surfaces are left to the fallback", "ssrlab"}};
    Param<unsigned> max_rays{params, "max_rays", 1, {1, 4},
        {"rays", "of each traced pixel; with classification of those in a tile whose probes differ", "slides measure 1 and 4"},
        Use::constant};
    Choice lobe{params, "lobe", "normals", {"normals", "visible_normals"},
        {"", "the distribution that half vectors are drawn from: the GGX distribution of normals, or of normals visible "
         "from the viewer", "slides: normals; visible normals (Heitz 2014) are listed as to be tried"}};
    Param<float> importance_bias{params, "importance_bias", 0.7f, {0.0f, 0.99f},
        {"of the lobe", "share of the lobe that is cut off: its tail", "slides: 0.7"}};
    Param<unsigned> max_regenerations{params, "max_regenerations", 4, {0, 16},
        {"", "times that a ray below the horizon is drawn again", "slides: a few times; the number is ours"}};
    // clang-format on

    nlohmann::json values() const;  ///< of these, by name
};
