#pragma once
#include "core/decoded_image.h"

/// See decode_image() of decoded_image.h: baseline and progressive JPEGs of grey or three components, of 8 bits; alpha
/// is 255. Complaints of libjpeg that do not harm the picture become warnings: stray bytes, or a missing end after
/// complete data. Fails with Error if data are missing or broken. CMYK, YCCK, 12-bit, lossless and hierarchical JPEGs
/// also fail; the message names the kind and a command that converts the file.
DecodedImage decode_jpeg(const EncodedImage& image, unsigned longest_side);
