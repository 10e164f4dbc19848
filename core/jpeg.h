#pragma once
#include "core/decoded_image.h"

/// See decode_image() of decoded_image.h: baseline and progressive JPEGs of grey or three components, of 8 bits; alpha
/// is 255. What libjpeg complains of without harm to the picture becomes a warning: bytes that belong to nothing, a
/// missing end behind whole data. Fails with Error where data are missing or broken, and, with what the file is and a
/// command that converts it, for CMYK and YCCK, 12 bits, and lossless or hierarchical JPEGs.
DecodedImage decode_jpeg(const EncodedImage& image, unsigned longest_side);
