#pragma once
#include "core/host_image.h"
#include "core/shared/camera.h"

#include <cstdint>
#include <vector>

inline constexpr float cos_normal_step =
    0.9396926f;  ///< cosine of 20 degrees: normals farther apart belong to two surfaces

/// The G-buffer's data of the previous frame. All images have its extent.
struct PreviousFrame {
    const CameraData& camera;  ///< of the current frame; it also holds the previous frame's matrices
    const HostImage& motion;   ///< 2 channels: uv_now - uv_before, without jitter
    const HostImage& depth;    ///< 1 channel: device depth before; camera.depth.z where nothing was hit
    const HostImage& normal;   ///< 3 or more channels: xyz unit shading normal before, world space
    float depth_step = 0;      ///< largest rounding of device depth: 2^-16 for d16, 2^-24 for d24
};

/// Per pixel, 1 where the previous frame did not show the surface, else 0. The surface's previous position was off the
/// screen, or its 1/depth and normal differ from all samples of a bilinear fetch there (metrics/README.md,
/// "Disocclusion"). Samples of background show background. The first frame (camera.frame.w == 0) has no disoccluded
/// pixel.
///
/// The mask holds surfaces only, not new reflections on surfaces that were visible. `view_depth`: 1 channel, distance
/// along the view axis in m; 0, negative or Inf where nothing was hit; `normal`: 3 or more channels; `material_id`: 1
/// channel. Fails where extents or channels differ.
std::vector<uint8_t> disoccluded(const HostImage& view_depth, const HostImage& normal, const HostImage& material_id,
                                 const PreviousFrame& previous);
