#pragma once
#include "core/gpu/image.h"

#include <span>

namespace vk {
enum class Format;  // of vulkan.hpp, whose headers cost seconds per source file
}

/// How a channel, or a texel that packs several, lies in memory.
enum class TexelCoding { unorm_8, unorm_16, unorm_24, half, float_11_11_10, uint_32, float_32 };

struct FormatFacts {
    Format format;
    const char* name;
    vk::Format vulkan;
    unsigned channels, bytes;  ///< of one texel; of depth with stencil the depth alone
    TexelCoding coding;
    const char* opengl_name;
    bool is_color_renderable, is_filterable;  ///< in WebGL 2 with EXT_color_buffer_float
};
const FormatFacts& facts_of(Format format);
/// All formats in the order of `Format`.
std::span<const FormatFacts> all_formats();

/// "rgba16f": as GLSL and this project call it.
std::string name_of(Format format);

/// The float format with as many channels of 32 or 16 bits. Depth, stencil and integer formats stay. r11g11b10f becomes
/// a format with alpha, which holds what the shader writes.
Format as_float32(Format format);
Format as_float16(Format format);

/// Whether depth tests, or stencil tests, can use an image of the format.
bool has_depth(Format format);
bool has_stencil(Format format);

/// Converts float32 channels to texels of the format, and back; one value per channel. Halves are rounded to the
/// nearest even, unorm values to the nearest after clamping to [0, 1].
void encode_texels(Format format, std::span<const float> values, std::byte* texels);
void decode_texels(Format format, const std::byte* texels, std::span<float> values);
