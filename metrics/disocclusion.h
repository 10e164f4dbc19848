#pragma once
#include "core/host_image.h"
#include "core/shared/camera.h"

#include <cstdint>
#include <vector>

inline constexpr float cos_normal_step = 0.9396926f;  ///< of 20 degrees: farther apart, normals are of two surfaces

/// What a G-buffer knows of the frame before. All images have its extent.
struct PreviousFrame {
    const CameraData& camera;  ///< of the frame now: it holds the matrices of the one before
    const HostImage& motion;   ///< 2 channels: uv_now - uv_before, without jitter
    const HostImage& depth;    ///< 1 channel: device depth before; camera.depth.z where nothing was hit
    const HostImage& normal;   ///< 3 or more channels: xyz unit shading normal before, world space
    float depth_step = 0;      ///< by which device depth was rounded at most: 2^-16 for d16, 2^-24 for d24
};

/// Per pixel, 1 where the frame before did not show the surface: its place then was off the screen, or the samples that
/// a bilinear fetch there blends do not show it. They do where 1/depth, which is affine over every plane, lies between
/// those of the samples whose normals are within 20 degrees, give or take 2 % (the limits of the mask `edge`); or
/// between those of all samples, give or take 1/4 %, since normal maps turn normals by more within a pixel. Background
/// is shown by samples of background. None in the first frame (camera.frame.w == 0).
///
/// Where a surface was on the screen is known from `motion`; how far away it was, only if it stood still. Otherwise it
/// may have kept its distance, or the distance follows from how much the motion magnifies it: the image of a rigid,
/// small piece of surface covers an area in proportion to |n . r| / z^2, with r the ray through it at unit depth, so
/// z_before = z sqrt(a / det(d uv_before / d uv_now)), a the ratio of |n . r| before to now. The derivative is a
/// difference between neighbouring pixels of the same surface; the limits are 5 % and 5/8 % then, and the samples may
/// show either distance: the second one is unsure at silhouettes, and unknown in an orthographic view, whose areas do
/// not shrink with distance.
///
/// It is the surface that was hidden; a reflection in it may be newly seen on surfaces that were visible all along, and
/// the mask does not hold those. `view_depth`: 1 channel, distance along the view axis in m; 0, negative or Inf where
/// nothing was hit; `normal`: 3 or more channels; `material_id`: 1 channel. Fails where extents or channels differ.
std::vector<uint8_t> disoccluded(const HostImage& view_depth, const HostImage& normal, const HostImage& material_id,
                                 const PreviousFrame& previous);
