#include "core/gpu/format.h"

#include "core/gpu/device_impl.h"

#include "core/error.h"

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace {

/// The last two columns: OpenGL ES 3.0.6, section 3.8.3, the tables of sized internal formats and the completeness of
/// depth textures (3.8.13); targets of floats: EXT_color_buffer_float.
// clang-format off
constexpr FormatFacts formats[] = {
    {Format::r8,         "r8",         vk::Format::eR8Unorm,               1, 1,  TexelCoding::unorm_8,        "R8",                 true,  true},
    {Format::rg8,        "rg8",        vk::Format::eR8G8Unorm,             2, 2,  TexelCoding::unorm_8,        "RG8",                true,  true},
    {Format::rgba8,      "rgba8",      vk::Format::eR8G8B8A8Unorm,         4, 4,  TexelCoding::unorm_8,        "RGBA8",              true,  true},
    {Format::rgba8_srgb, "rgba8_srgb", vk::Format::eR8G8B8A8Srgb,          4, 4,  TexelCoding::unorm_8,        "SRGB8_ALPHA8",       true,  true},
    {Format::r16f,       "r16f",       vk::Format::eR16Sfloat,             1, 2,  TexelCoding::half,           "R16F",               true,  true},
    {Format::rg16f,      "rg16f",      vk::Format::eR16G16Sfloat,          2, 4,  TexelCoding::half,           "RG16F",              true,  true},
    {Format::rgba16f,    "rgba16f",    vk::Format::eR16G16B16A16Sfloat,    4, 8,  TexelCoding::half,           "RGBA16F",            true,  true},
    {Format::r32f,       "r32f",       vk::Format::eR32Sfloat,             1, 4,  TexelCoding::float_32,       "R32F",               true,  false},
    {Format::rg32f,      "rg32f",      vk::Format::eR32G32Sfloat,          2, 8,  TexelCoding::float_32,       "RG32F",              true,  false},
    {Format::rgba32f,    "rgba32f",    vk::Format::eR32G32B32A32Sfloat,    4, 16, TexelCoding::float_32,       "RGBA32F",            true,  false},
    {Format::r11g11b10f, "r11g11b10f", vk::Format::eB10G11R11UfloatPack32, 3, 4,  TexelCoding::float_11_11_10, "R11F_G11F_B10F",     true,  true},
    {Format::r32ui,      "r32ui",      vk::Format::eR32Uint,               1, 4,  TexelCoding::uint_32,        "R32UI",              true,  false},
    {Format::d32f,       "d32f",       vk::Format::eD32Sfloat,             1, 4,  TexelCoding::float_32,       "DEPTH_COMPONENT32F", false, false},
    {Format::d24,        "d24",        vk::Format::eX8D24UnormPack32,      1, 4,  TexelCoding::unorm_24,       "DEPTH_COMPONENT24",  false, false},
    {Format::d16,        "d16",        vk::Format::eD16Unorm,              1, 2,  TexelCoding::unorm_16,       "DEPTH_COMPONENT16",  false, false},
    {Format::d32f_s8,    "d32f_s8",    vk::Format::eD32SfloatS8Uint,       1, 4,  TexelCoding::float_32,       "DEPTH32F_STENCIL8",  false, false},
};
// clang-format on

}  // namespace

std::span<const FormatFacts> all_formats() { return formats; }

const FormatFacts& facts_of(Format format) {
    const auto* const found = std::ranges::find(formats, format, &FormatFacts::format);
    if (found == std::end(formats)) fail("nothing is known of Format ", int(format));
    return *found;
}

vk::Format vulkan_format(Format format) { return facts_of(format).vulkan; }

vk::ImageAspectFlags aspect_of(Format format) {
    using Aspect = vk::ImageAspectFlagBits;
    if (has_stencil(format)) return Aspect::eDepth | Aspect::eStencil;
    return has_depth(format) ? Aspect::eDepth : Aspect::eColor;
}

bool has_depth(Format format) {
    return format == Format::d32f || format == Format::d24 || format == Format::d16 || has_stencil(format);
}

bool has_stencil(Format format) { return format == Format::d32f_s8; }

std::string name_of(Format format) { return facts_of(format).name; }

namespace {

/// `of_channels`: of one, of two, of more.
Format with_channels(Format format, const std::array<Format, 3>& of_channels) {
    const FormatFacts& facts = facts_of(format);
    if (!facts.is_color_renderable || facts.coding == TexelCoding::uint_32) return format;
    return of_channels[std::min(facts.channels, 3u) - 1];
}

template <class Texel>
void write(std::byte* texels, size_t index, Texel value) {
    std::memcpy(texels + index * sizeof(Texel), &value, sizeof(Texel));
}

template <class Texel>
Texel read(const std::byte* texels, size_t index) {
    Texel value;
    std::memcpy(&value, texels + index * sizeof(Texel), sizeof(Texel));
    return value;
}

/// Unsigned floats of 11 or 10 bits have the exponent of a half and its upper 6 or 5 bits of mantissa.
uint32_t small_float(float value, int dropped_bits) {
    return uint32_t((half(std::max(value, 0.0f)).bits() + (1 << (dropped_bits - 1))) >> dropped_bits);
}
float from_half_bits(uint32_t bits) {
    half h;
    h.setBits(uint16_t(bits));
    return h;
}

float clamped(float value) { return std::clamp(value, 0.0f, 1.0f); }

}  // namespace

Format as_float32(Format format) { return with_channels(format, {Format::r32f, Format::rg32f, Format::rgba32f}); }
Format as_float16(Format format) { return with_channels(format, {Format::r16f, Format::rg16f, Format::rgba16f}); }

void encode_texels(Format format, std::span<const float> values, std::byte* texels) {
    const auto each = [&](auto coded) {
        for (size_t i = 0; i < values.size(); ++i) write(texels, i, coded(values[i]));
    };
    switch (facts_of(format).coding) {
        case TexelCoding::unorm_8:
            return each([](float v) { return uint8_t(std::lround(clamped(v) * 255.0f)); });
        case TexelCoding::unorm_16:
            return each([](float v) { return uint16_t(std::lround(clamped(v) * 65535.0f)); });
        case TexelCoding::unorm_24:
            return each([](float v) { return uint32_t(std::lround(double(clamped(v)) * 16777215.0)); });
        case TexelCoding::half:
            return each([](float v) { return half(v).bits(); });
        case TexelCoding::uint_32:
            return each([](float v) { return uint32_t(v); });
        case TexelCoding::float_11_11_10:
            for (size_t i = 0; i + 2 < values.size(); i += 3)
                write(texels, i / 3,
                      small_float(values[i], 4) | small_float(values[i + 1], 4) << 11 |
                          small_float(values[i + 2], 5) << 22);
            return;
        case TexelCoding::float_32:
            std::memcpy(texels, values.data(), values.size_bytes());
    }
}

void decode_texels(Format format, const std::byte* texels, std::span<float> values) {
    const auto each = [&]<class Texel>(Texel, auto decoded) {
        for (size_t i = 0; i < values.size(); ++i) values[i] = decoded(read<Texel>(texels, i));
    };
    switch (facts_of(format).coding) {
        case TexelCoding::unorm_8:
            return each(uint8_t(), [](uint8_t v) { return float(v) / 255.0f; });
        case TexelCoding::unorm_16:
            return each(uint16_t(), [](uint16_t v) { return float(v) / 65535.0f; });
        case TexelCoding::unorm_24:
            return each(uint32_t(), [](uint32_t v) { return float(double(v & 0xffffff) / 16777215.0); });
        case TexelCoding::half:
            return each(uint16_t(), [](uint16_t v) { return from_half_bits(v); });
        case TexelCoding::uint_32:
            return each(uint32_t(), [](uint32_t v) { return float(v); });
        case TexelCoding::float_11_11_10:
            for (size_t i = 0; i + 2 < values.size(); i += 3) {
                const uint32_t bits = read<uint32_t>(texels, i / 3);
                values[i] = from_half_bits((bits & 0x7ff) << 4),
                values[i + 1] = from_half_bits((bits >> 11 & 0x7ff) << 4),
                values[i + 2] = from_half_bits(bits >> 22 << 5);
            }
            return;
        case TexelCoding::float_32:
            std::memcpy(values.data(), texels, values.size_bytes());
    }
}
