#pragma once
#include "core/host_image.h"

/// Makes the table of blue noise: 128x128 texels of two channels with values v / 255, v in 0..255. About a second; the
/// same on every machine, since all sums are of integers.
///
/// The pairs v are the 2^14 points of a Hammersley net in base 2: in each channel every code occurs 64 times, and in the
/// unit square every box of 2^-a by 2^-b with a, b <= 8 <= 14 - a - b... holds its exact share. Where each pair lies is
/// found by swapping two texels if that lowers an energy (Georgiev and Fajardo 2016, "Blue-noise Dithered Sampling"):
/// that of the low frequencies of the images of several test functions of the pair, as the error of integrals over pairs
/// is what has to be blue (Heitz et al. 2019, "A Low-Discrepancy Sampler that Distributes Monte Carlo Errors as a Blue
/// Noise in Screen Space").
HostImage make_blue_noise_table();
