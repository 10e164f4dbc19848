#include "core/gpu/format.h"

#include "core/error.h"

#include <Imath/half.h>
#include <algorithm>
#include <cmath>
#include <cstring>

vk::Format vulkan_format(Format format) {
    switch (format) {
        case Format::r8:
            return vk::Format::eR8Unorm;
        case Format::rg8:
            return vk::Format::eR8G8Unorm;
        case Format::rgba8:
            return vk::Format::eR8G8B8A8Unorm;
        case Format::rgba8_srgb:
            return vk::Format::eR8G8B8A8Srgb;
        case Format::r16f:
            return vk::Format::eR16Sfloat;
        case Format::rg16f:
            return vk::Format::eR16G16Sfloat;
        case Format::rgba16f:
            return vk::Format::eR16G16B16A16Sfloat;
        case Format::r32f:
            return vk::Format::eR32Sfloat;
        case Format::rg32f:
            return vk::Format::eR32G32Sfloat;
        case Format::rgba32f:
            return vk::Format::eR32G32B32A32Sfloat;
        case Format::r11g11b10f:
            return vk::Format::eB10G11R11UfloatPack32;
        case Format::r32ui:
            return vk::Format::eR32Uint;
        case Format::d32f:
            return vk::Format::eD32Sfloat;
        case Format::d24:
            return vk::Format::eX8D24UnormPack32;
        case Format::d16:
            return vk::Format::eD16Unorm;
        case Format::d32f_s8:
            return vk::Format::eD32SfloatS8Uint;
    }
    fail("no Vulkan format for Format ", int(format));
}

vk::ImageAspectFlags aspect_of(Format format) {
    switch (format) {
        case Format::d32f:
        case Format::d24:
        case Format::d16:
            return vk::ImageAspectFlagBits::eDepth;
        case Format::d32f_s8:
            return vk::ImageAspectFlagBits::eDepth | vk::ImageAspectFlagBits::eStencil;
        default:
            return vk::ImageAspectFlagBits::eColor;
    }
}

TexelLayout texel_layout(Format format) {
    switch (format) {
        case Format::r8:
            return {1, 1};
        case Format::rg8:
            return {2, 2};
        case Format::rgba8:
        case Format::rgba8_srgb:
            return {4, 4};
        case Format::r16f:
            return {1, 2};
        case Format::rg16f:
            return {2, 4};
        case Format::rgba16f:
            return {4, 8};
        case Format::r32f:
        case Format::r32ui:
            return {1, 4};
        case Format::rg32f:
            return {2, 8};
        case Format::rgba32f:
            return {4, 16};
        case Format::r11g11b10f:
            return {3, 4};
        case Format::d16:
            return {1, 2};
        case Format::d32f:
        case Format::d24:
        case Format::d32f_s8:
            return {1, 4};
    }
    fail("no texel layout for Format ", int(format));
}

namespace {

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
float from_small_float(uint32_t bits, int dropped_bits) {
    half h;
    h.setBits(uint16_t(bits << dropped_bits));
    return h;
}

float unorm(float value) { return std::clamp(value, 0.0f, 1.0f); }

}  // namespace

void encode_texels(Format format, std::span<const float> values, std::byte* texels) {
    switch (format) {
        case Format::r8:
        case Format::rg8:
        case Format::rgba8:
        case Format::rgba8_srgb:
            for (size_t i = 0; i < values.size(); ++i)
                write(texels, i, uint8_t(std::lround(unorm(values[i]) * 255.0f)));
            return;
        case Format::r16f:
        case Format::rg16f:
        case Format::rgba16f:
            for (size_t i = 0; i < values.size(); ++i) write(texels, i, half(values[i]).bits());
            return;
        case Format::r11g11b10f:
            for (size_t i = 0; i + 2 < values.size(); i += 3)
                write(texels, i / 3,
                      small_float(values[i], 4) | small_float(values[i + 1], 4) << 11 |
                          small_float(values[i + 2], 5) << 22);
            return;
        case Format::r32ui:
            for (size_t i = 0; i < values.size(); ++i) write(texels, i, uint32_t(values[i]));
            return;
        case Format::d16:
            for (size_t i = 0; i < values.size(); ++i)
                write(texels, i, uint16_t(std::lround(unorm(values[i]) * 65535.0f)));
            return;
        case Format::d24:
            for (size_t i = 0; i < values.size(); ++i)
                write(texels, i, uint32_t(std::lround(double(unorm(values[i])) * 16777215.0)));
            return;
        default:
            std::memcpy(texels, values.data(), values.size_bytes());
    }
}

void decode_texels(Format format, const std::byte* texels, std::span<float> values) {
    switch (format) {
        case Format::r8:
        case Format::rg8:
        case Format::rgba8:
        case Format::rgba8_srgb:
            for (size_t i = 0; i < values.size(); ++i) values[i] = float(read<uint8_t>(texels, i)) / 255.0f;
            return;
        case Format::r16f:
        case Format::rg16f:
        case Format::rgba16f:
            for (size_t i = 0; i < values.size(); ++i) {
                half h;
                h.setBits(read<uint16_t>(texels, i));
                values[i] = h;
            }
            return;
        case Format::r11g11b10f:
            for (size_t i = 0; i + 2 < values.size(); i += 3) {
                const uint32_t bits = read<uint32_t>(texels, i / 3);
                values[i] = from_small_float(bits & 0x7ff, 4), values[i + 1] = from_small_float(bits >> 11 & 0x7ff, 4),
                values[i + 2] = from_small_float(bits >> 22, 5);
            }
            return;
        case Format::r32ui:
            for (size_t i = 0; i < values.size(); ++i) values[i] = float(read<uint32_t>(texels, i));
            return;
        case Format::d16:
            for (size_t i = 0; i < values.size(); ++i) values[i] = float(read<uint16_t>(texels, i)) / 65535.0f;
            return;
        case Format::d24:
            for (size_t i = 0; i < values.size(); ++i)
                values[i] = float(double(read<uint32_t>(texels, i) & 0xffffff) / 16777215.0);
            return;
        default:
            std::memcpy(values.data(), texels, values.size_bytes());
    }
}
