#include "core/gpu/precision.h"

#include "core/error.h"

#include <array>

namespace {

struct FormatNames {
    Format format;
    const char* name;
    Format wide, half;
};

/// By Format.
constexpr std::array<FormatNames, 16> formats = {{
    {Format::r8, "r8", Format::r32f, Format::r16f},
    {Format::rg8, "rg8", Format::rg32f, Format::rg16f},
    {Format::rgba8, "rgba8", Format::rgba32f, Format::rgba16f},
    {Format::rgba8_srgb, "rgba8_srgb", Format::rgba32f, Format::rgba16f},
    {Format::r16f, "r16f", Format::r32f, Format::r16f},
    {Format::rg16f, "rg16f", Format::rg32f, Format::rg16f},
    {Format::rgba16f, "rgba16f", Format::rgba32f, Format::rgba16f},
    {Format::r32f, "r32f", Format::r32f, Format::r16f},
    {Format::rg32f, "rg32f", Format::rg32f, Format::rg16f},
    {Format::rgba32f, "rgba32f", Format::rgba32f, Format::rgba16f},
    {Format::r11g11b10f, "r11g11b10f", Format::rgba32f, Format::rgba16f},
    {Format::r32ui, "r32ui", Format::r32ui, Format::r32ui},
    {Format::d32f, "d32f", Format::d32f, Format::d32f},
    {Format::d24, "d24", Format::d24, Format::d24},
    {Format::d16, "d16", Format::d16, Format::d16},
    {Format::d32f_s8, "d32f_s8", Format::d32f_s8, Format::d32f_s8},
}};

const FormatNames& row_of(Format format) {
    for (const FormatNames& row : formats)
        if (row.format == format) return row;
    fail("no name for Format ", int(format));
}

}  // namespace

Format as_float32(Format format) { return row_of(format).wide; }
Format as_float16(Format format) { return row_of(format).half; }
std::string name_of(Format format) { return row_of(format).name; }
