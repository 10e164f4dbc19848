#pragma once
#include "core/gbuffer/gbuffer_file.h"

#include <string>
#include <vector>

/// Motion vectors of surfaces that stand still (and of the sky at infinity), from the depth and both cameras: uv now -
/// uv before, y down, two channels. 0 where the point was behind the camera.
HostImage camera_motion(const HostGBuffer& now, const CameraData& before);

/// Errors within one frame that do not prevent rendering: values out of range, a camera whose matrices contradict its
/// planes, normals that contradict the depths. One sentence each, which names another convention (view space, +Z up,
/// flipped) if it would fit.
std::vector<std::string> check_gbuffer(const HostGBuffer& gbuffer);

/// Errors between two successive frames: motion vectors in another convention (from now to before, y up, pixels, clip
/// space), surfaces that are not where motion says, and a camera that jumps.
std::vector<std::string> check_motion(const HostGBuffer& before, const HostGBuffer& now);
