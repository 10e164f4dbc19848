#pragma once
#include "core/host_image.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

/// Writes an RGB image as 8-bit sRGB after multiplying by 2^exposure_ev and clamping to [0, 1]; NaN is written as
/// magenta, so that it is seen. Atomic as write_exr(), and fails as it does; with Error if the image has zero size.
void write_png(const std::filesystem::path& file, const HostImage& rgb, float exposure_ev = 0.0f);

/// Reads an 8-bit or 16-bit PNG, grey or colour, as sRGB *codes* in [0, 1] (not linear), three channels.
/// Fails with Error if the file is missing or no PNG, or if its header announces more than may be read
/// (reading_limits.h).
HostImage read_png_codes(const std::filesystem::path& file);

/// The codes of a PNG in memory as 8-bit RGBA, row by row, whatever colours it has; 16-bit ones are rounded. None if it is
/// no intact PNG. Takes 12 bytes per pixel of its header at most, however much its data would inflate to.
std::optional<std::vector<uint8_t>> decode_png_rgba(std::span<const uint8_t> file);

/// IEC 61966-2-1, both ways; 0 and 1 are kept.
float srgb_from_linear(float linear);
float linear_from_srgb(float code);
