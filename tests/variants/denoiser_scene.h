#pragma once
#include "core/scene/camera.h"
#include "tests/variants/amd_denoiser_bench.h"

#include <functional>

/// A wall across the whole view, facing the camera, that reflects a colour per pixel. All tiles are listed.
struct FacingWall {
    glm::uvec2 extent{64, 64};
    float distance = 4, distance_before = 4;  ///< m, of this and the previous frame's camera
    float alpha = 0.05f;
    std::function<glm::vec3(unsigned x, unsigned y)> color = [](unsigned, unsigned) { return glm::vec3(0.5f); };
};
DenoiserInputs facing_wall(const FacingWall& wall);

/// 0.25 and 0.75 by turns, so that colours around a pixel vary and clip little.
glm::vec3 checkered(unsigned x, unsigned y);

/// Frame `index` of a camera that moves sideways over a floor in strips of different alpha, with a ball on it, before a
/// checkered wall; noise grows with alpha. Tiles are listed where any pixel is glossy. `previous`: the frame before.
DenoiserInputs floor_and_ball(glm::uvec2 extent, DepthDirection direction, unsigned index, unsigned previous);
