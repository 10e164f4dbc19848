#pragma once
#include "core/host_image.h"

/// Samples that pixels get beyond the `uniform` samples that each has; one channel, 0 or 16 * 2^k. Their sum is at most
/// `share` * `uniform` for each pixel with a surface, and nearly that.
///
/// The noise of an MSE is the sum of the variances of all pixels, and a few pixels have most of that sum: those that
/// mirror lamps. The sum is least if a pixel's samples are proportional to its standard deviation (Neyman 1934, "On the
/// Two Different Aspects of the Representative Method"). `guide_variance` (RGB) estimates it from the samples of the
/// guide, which the reference does not hold. So no count depends on the samples that it counts, and no mean has a bias.
/// `material_id`: 0 where there is no surface.
HostImage adaptive_samples(const HostImage& guide_variance, const HostImage& material_id, uint64_t uniform,
                           double share);
