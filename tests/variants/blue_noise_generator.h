#pragma once
#include "core/host_image.h"

#include <cstdint>
#include <vector>

/// Makes the table of blue noise: 128x128 texels of two channels with values v / 255, v in 0..255. About a second; the
/// same on every machine, since all sums are of integers.
///
/// The pairs v are the 2^14 points of a Hammersley net in base 2: each code occurs 64 times in each channel, and every
/// box of the unit square with sides 2^-6 by 2^-8, 2^-7 by 2^-7 or 2^-8 by 2^-6 holds one pair. Where a pair lies is
/// found by swapping texels wherever that lowers an energy (Georgiev and Fajardo 2016, "Blue-noise Dithered Sampling"):
/// the low frequencies of the images of several test functions of the pair, since it is the error of integrals over the
/// pairs that has to be blue (Heitz et al. 2019, "A Low-Discrepancy Sampler that Distributes Monte Carlo Errors as a
/// Blue Noise in Screen Space").
HostImage make_blue_noise_table();

/// Makes the texture of blue noise: 64x64 texels of four bytes, row by row, which tiles in both directions, by the
/// void-and-cluster method (Ulichney 1993, "The void-and-cluster method for dither array generation") in each channel
/// alone. In each every code 0..255 occurs 16 times. A fraction of a second; the same on every machine, too.
std::vector<uint8_t> make_blue_noise_texture();
