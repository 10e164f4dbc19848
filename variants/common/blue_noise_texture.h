#pragma once
#include <cstdint>
#include <vector>

constexpr unsigned blue_noise_texture_width = 64;

/// 64x64 texels of four bytes, row by row: blue noise that tiles in both directions, made by the void-and-cluster
/// method (Ulichney 1993, "The void-and-cluster method for dither array generation") in each channel alone. In each
/// every code 0..255 occurs 16 times. Made on the first call, in a fraction of a second; the same on every machine,
/// since all sums are of integers.
const std::vector<uint8_t>& blue_noise_texture();
