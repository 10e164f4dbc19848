#pragma once
#include "core/host_image.h"
#include "metrics/cvvdp/display.h"
#include "metrics/float_plane.h"

#include <span>

/// The opponent channels of an image: achromatic, red-green, yellow-violet. The achromatic one is the sum of L and M
/// cones, 1.051 per cd/m2 of white.
inline constexpr unsigned opponent_channels = 3;

/// Writes the opponent channels of two images of three channels and of the planes' size. A pixel with NaN or Inf in
/// either image is black in both. Returns the number of such pixels.
size_t to_opponent(const HostImage& reference, const HostImage& test, const Viewing& viewing,
                   std::span<FloatPlane> reference_out, std::span<FloatPlane> test_out);
