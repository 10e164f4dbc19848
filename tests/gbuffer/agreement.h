#pragma once
#include "tests/gbuffer/test_scenes.h"

/// How many of the pixels that are not next to an edge agree with Embree's ray through the pixel's centre.
struct Agreement {
    size_t compared = 0, depth = 0, geometric_normal = 0, normal = 0, material = 0, surface = 0;
};

/// Draws the frame and traces it. Rays go through pixel centres, whatever view.jitter is.
Agreement compare_with_rays(const Scene& scene, const SceneCamera& camera, const FrameView& view,
                            const RasterizerOptions& options = {});

/// Prints the shares and expects 99.9 % of each.
void expect_agreement(const Agreement& agreement, const std::string& name);
