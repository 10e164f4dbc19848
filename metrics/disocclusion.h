#pragma once
#include "core/host_image.h"
#include "core/shared/camera.h"

#include <cstdint>
#include <vector>

inline constexpr float cos_normal_step = 0.9396926f;  ///< of 20 degrees: farther apart, normals are of two surfaces

/// The G-buffer's data of the previous frame. All images have its extent.
struct PreviousFrame {
    const CameraData& camera;  ///< of the frame now: it holds the matrices of the one before
    const HostImage& motion;   ///< 2 channels: uv_now - uv_before, without jitter
    const HostImage& depth;    ///< 1 channel: device depth before; camera.depth.z where nothing was hit
    const HostImage& normal;   ///< 3 or more channels: xyz unit shading normal before, world space
    float depth_step = 0;      ///< by which device depth was rounded at most: 2^-16 for d16, 2^-24 for d24
};

/// Per pixel, 1 where the previous frame did not show the surface: its position then was off the screen, or the samples
/// of a bilinear fetch there do not show it, by 1/depth and normals (metrics/README.md, "Disocclusion"). Background is
/// shown by samples of background. None in the first frame (camera.frame.w == 0).
///
/// The mask is of hidden surfaces; reflections that are newly visible on surfaces visible before are not in it.
/// `view_depth`: 1 channel, distance along the view axis in m; 0, negative or Inf where
/// nothing was hit; `normal`: 3 or more channels; `material_id`: 1 channel. Fails where extents or channels differ.
std::vector<uint8_t> disoccluded(const HostImage& view_depth, const HostImage& normal, const HostImage& material_id,
                                 const PreviousFrame& previous);
