#pragma once
#include "core/host_image.h"

#include <vector>

/// A float32 image without loss, small where neighbours are alike. page/record/texels.js decodes it.
struct TexelStream {
    std::vector<unsigned> shifts;      ///< by channel: number of lowest bits that are 0 in all values and left out
    std::vector<unsigned char> bytes;  ///< a zlib stream
};

/// Encodes each channel in these steps. The bits become integers in the order of the numbers. The prediction of the
/// median edge detector (LOCO-I, Weinberger et al. 2000) from neighbours is subtracted, modulo 2^32. The sign moves to
/// the lowest bit. The lowest bytes of all pixels come first, then the next ones.
TexelStream encode_floats(const HostImage& image);
