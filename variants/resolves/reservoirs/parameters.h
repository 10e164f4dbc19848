#pragma once
#include "core/parameters.h"

/// Parameters of the reservoirs. "kajiya" is Embark Studios' renderer at commit 9fdec0f0 (MIT or Apache-2.0 licence),
/// assets/shaders/rtr: "temporal" is rtr_restir_temporal.hlsl, "resolve" resolve.hlsl; it follows Bitterli et al. 2020,
/// "Spatiotemporal reservoir resampling", and Ouyang et al. 2021, "ReSTIR GI".
struct ReservoirParameters {
    ParameterSet& params;

    // clang-format off
    // What both passes read.
    Param<float> max_density{params, "max_density", 200.0f, {1.0f, 1e6f},
        {"sr^-1", "densities count as this at most, so that narrow lobes do not outweigh others", "kajiya, temporal"}};

    // A reservoir keeps one ray of those that its pixel had.
    Switch temporal_reuse{params, "temporal_reuse", true,
        {"", "reservoirs outlive a frame; otherwise they hold this frame's ray", "ssrlab, to measure the stage"}};
    Param<float> max_history{params, "max_history", 8.0f, {0.0f, 1024.0f},
        {"rays", "that the reservoir of the frame before stands for at most", "kajiya, temporal"}};
    Param<float> min_luminance{params, "min_luminance", 1e-3f, {1e-6f, 1.0f},
        {"W sr^-1 m^-2", "rays that see less are kept as often as if they saw this", "kajiya, temporal"}};
    Param<float> max_offset{params, "max_offset", 0.05f, {0.0f, 1.0f},
        {"", "square of how far from its pixel a ray may have started, over the distance from the camera",
         "kajiya, temporal"}};

    // What a pixel shows of the reservoirs around it.
    Switch spatial_reuse{params, "spatial_reuse", true,
        {"", "also reads neighbours' reservoirs", "ssrlab, to measure the stage"}};
    Param<float> disk_scale{params, "disk_scale", 0.25f, {0.0f, 10.0f},
        {"", "radius of the disk of neighbours over the square root of alpha and the size at which the mirror image's "
         "distance lets the length of the ray appear", "kajiya, resolve"}};
    Param<float> min_radius{params, "min_radius", 2.0f, {0.0f, 100.0f},
        {"pixels", "of the disk", "kajiya, resolve"}};
    Param<float> max_radius{params, "max_radius", 0.05f, {0.0f, 1.0f},
        {"of the screen's height", "of the disk", "kajiya, resolve"}};
    // clang-format on
};
