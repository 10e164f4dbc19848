#pragma once
#include "core/host_image.h"

#include <vector>

/// An image of float32 without loss, small where neighbours are alike: what page/record/texels.js decodes.
struct TexelStream {
    std::vector<unsigned> shifts;      ///< of each channel: lowest bits that are 0 in all of its values, left out
    std::vector<unsigned char> bytes;  ///< a zlib stream
};

/// Of each channel the bits as integers in the order of the numbers, less what the median edge detector (LOCO-I,
/// Weinberger et al. 2000) foretells from its neighbours, modulo 2^32, the sign moved to the lowest bit; first the
/// lowest bytes of all pixels, then the next ones.
TexelStream encode_floats(const HostImage& image);
