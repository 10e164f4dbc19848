#pragma once
#include "core/decoded_image.h"

/// See decode_image() of decoded_image.h: still pictures of WebP (RFC 9649), lossy and lossless. Fails with Error for
/// animations, too.
DecodedImage decode_webp(const EncodedImage& image, unsigned longest_side);
