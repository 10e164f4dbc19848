#pragma once
#include "core/parameters.h"

/// Parameters of the accumulation by speed. "HDRP" is the PBR accumulation of ScreenSpaceReflections.compute of Unity's
/// High Definition Render Pipeline (Unity Companion License) at commit 0d4b0874, with the defaults of
/// ScreenSpaceReflection.cs at 17c1d465: formulas alone were taken. Switches under "corrections" fix one defect each.
struct SpeedAccumulationParameters {
    ParameterSet& params;

    // clang-format off
    // From rays to pixels.
    Switch reuse_neighbors{params, "reuse_neighbors", true,
        {"", "the mean of the rays of the pixel and of the four next to it, except where it is a perfect mirror; "
         "otherwise of its own", "HDRP; the switch, to measure the stage, and mirrors, where the original has no "
         "number, are ours"}};

    // History.
    Switch temporal_accumulation{params, "temporal_accumulation", true,
        {"", "blends with what the same pixel reflected before", "HDRP; a switch to measure the stage"}};
    Param<float> accumulation{params, "accumulation", 0.75f, {0.0f, 1.0f},
        {"", "a frame's share of the mean is 2^(-7 accumulation) where nothing moves", "HDRP, accumulation factor"}};
    Choice rejection{params, "rejection", "screen", {"screen", "legacy_screen", "world_hard", "world_smooth"},
        {"", "how that share grows with speed. screen: with the way on the screen to 1 at 1/640 of its width or "
         "height; legacy_screen: to 1 at 1/128, whatever speed_rejection is; world_hard: to 1 at once from 1 - "
         "speed_rejection of the largest speed in space on; world_smooth: up to speed_rejection at that speed", "HDRP: "
         "screen, with its world speed rejection and its smooth one both, legacy_screen at commit 94d05603"},
        Use::uniform};
    Choice speed_of{params, "speed_of", "both", {"both", "surface", "target"},
        {"", "what moves: the surface, what its ray met, or their sum", "HDRP, speed of surface and of target"},
        Use::uniform};
    Param<float> speed_rejection{params, "speed_rejection", 0.5f, {0.0f, 1.0f},
        {"", "how much speed takes from history; 0: nothing, except with legacy_screen, and from the largest speed on with world_hard", "HDRP, speed rejection"}};
    Param<float> world_speed_scale{params, "world_speed_scale", 0.2f, {0.001f, 1.0f},
        {"", "the largest speed in space is the square of a tenth of it: m per frame", "HDRP, speed scaler"}};

    // Corrections.
    Switch local_frame{params, "local_frame", false,
        {"", "a ray's weight is masking over shadowing in the frame of its own surface. The original takes the "
         "world's z axis for the normal, so that weights change when the scene is turned", "ssrlab"}};
    Switch ratio_estimator{params, "ratio_estimator", false,
        {"", "a ray's weight is the pixel's own lobe, towards what the ray met, over the density with which it was "
         "drawn. In the original it is of the lobe of the surface that the ray started from", "ssrlab; Stachowiak & "
         "Uludag 2015"}};
    Switch average_confidence{params, "average_confidence", false,
        {"", "rays without a hit count as not known. In the original neighbours' misses are left out, and a pixel "
         "whose own ray misses shows nothing", "ssrlab"}, Use::uniform};
    Switch misses_stand_still{params, "misses_stand_still", false,
        {"", "a ray without a hit has no target that moves. The original takes the speed of the screen's first "
         "pixel", "ssrlab"}, Use::uniform};
    Switch depth_of_target{params, "depth_of_target", false,
        {"", "a target's speed in space is that at its own depth. The original takes the depth of the screen's first "
         "pixel", "ssrlab"}, Use::uniform};
    Switch add_speeds{params, "add_speeds", false,
        {"", "the lengths of the ways in space are added, as those on the screen. In the original opposite ones "
         "cancel", "ssrlab"}, Use::uniform};
    Switch reproject_history{params, "reproject_history", false,
        {"", "history is that of where the surface was, if it was seen there. In the original it is that of the same "
         "pixel", "ssrlab"}};
    Switch average_evenly{params, "average_evenly", false,
        {"", "all frames since the last rejection count alike until there are so many that the share is reached. In "
         "the original one frame starts anew, whose noise stays", "ssrlab"}, Use::uniform};
    // clang-format on
};
