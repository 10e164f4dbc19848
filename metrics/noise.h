#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"

// A path-traced reference R = (A + B) / 2 has noise of its own, which a squared error counts as the test image's. With
// two independent halves it can be taken out without bias, since their noises are uncorrelated:
//     E[(x - A)(x - B)] = (x - truth)^2,     (x - A)(x - B) = (x - R)^2 - (A - B)^2 / 4.
// Single pixels may be negative and must not be clamped before they are averaged.

/// mean over channels of weight(w) (x - A)(x - B) of each pixel, w the pixel of `weighing`.
Plane cross_error(const HostImage& test, const HostImage& half_a, const HostImage& half_b, const HostImage& weighing,
                  double (*weight)(double));

/// R with its noise removed where its halves show that it is noise. Of a pixel's distance d from the mean of its 8
/// neighbours, d max(0, 1 - 4 v / d^2) is kept, where v is the noise variance, (A - B)^2 / 4 averaged over 3x3 pixels:
/// less than two standard deviations pass for noise (the non-negative garrote of Breiman 1995, "Better Subset
/// Regression Using the Nonnegative Garrote"). Where A = B it is R itself. Relative errors are weighted by it, since a
/// weight made of the pixel's own noise would be correlated with the error that it weighs, and 1 / r^2 of a noisy r is
/// too large on average.
HostImage without_noise(const HostImage& half_a, const HostImage& half_b);

/// Half the width of the 95 % interval that the reference's noise leaves to the masked mean of a per-pixel quantity.
/// `swapped` is half its change when A alone is the reference in place of B: (A, B) and (B, A) are equally likely, and
/// to first order it varies as much as the quantity does. For squared errors the agreement is exact if the noise is
/// Gaussian: both have the variance 2 s^2 (x - truth)^2 + s^4 with s^2 that of a half. Bootstrap: 2000 draws of a
/// random swap for each tile of 16x16 pixels, so that noise may be correlated inside of a tile (a wild bootstrap with
/// Rademacher signs: Davidson, Flachaire 2008, "The Wild Bootstrap, Tamed at Last"). Pixels are not resampled: they are
/// the whole image, not a sample of one. Seeded; the same bits each time.
double noise_half_width(const Plane& swapped, const Mask& mask);
