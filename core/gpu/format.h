#pragma once
#include "core/gpu/device_impl.h"

#include <span>

/// How the texels of a format lie in memory.
struct TexelLayout {
    unsigned channels, bytes;  ///< of one texel
};
TexelLayout texel_layout(Format format);

/// Texels of the format from float32 channels and back. Halves are rounded to the nearest even, unorm bytes to the
/// nearest.
void encode_texels(Format format, std::span<const float> values, std::byte* texels);
void decode_texels(Format format, const std::byte* texels, std::span<float> values);
