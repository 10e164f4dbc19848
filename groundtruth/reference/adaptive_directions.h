#pragma once
#include "core/host_image.h"
#include "groundtruth/paths/path_tracer.h"

struct RenderedGuide;

/// Directions of each lobe (Directions: diffuse, specular) that a sample of each pixel has; two channels, powers of two
/// from 1 to 64. Those beyond the first are at most `share` for each pixel with a surface (twice that for the image,
/// which has two lobes), and nearly that.
///
/// A few pixels have most of the noise: those that mirror lamps. Noise at equal cost is least if directions are
/// proportional to the standard deviation (Neyman 1934, "On the Two Different Aspects of the Representative Method").
/// The guide's samples estimate that, which the reference does not hold. So no number depends on the samples that it
/// multiplies, and no mean has a bias.
///
/// For the mean squared error (`for_image` false), specular directions alone are added, where the specular light has
/// the greatest variance. For the image, both lobes share what is added, and variances are relative to the squared
/// brightness of the pixel.
HostImage adaptive_directions(const RenderedGuide& guide, double share, bool for_image);

/// Of one pixel; one of each lobe if `all` is empty.
Directions directions_of(const HostImage& all, size_t pixel);
