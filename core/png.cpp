#include "core/png.h"

#include "core/error.h"
#include "core/files.h"

#include <png.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstdio>

float srgb_from_linear(float linear) {
    if (linear < 0.0f) return -srgb_from_linear(-linear);
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

template <class Real>
static Real decoded_srgb(Real code) {
    if (code < 0) return -decoded_srgb(-code);
    return code <= Real(0.04045) ? code / Real(12.92) : std::pow((code + Real(0.055)) / Real(1.055), Real(2.4));
}

float linear_from_srgb(float code) { return decoded_srgb(code); }
double linear_from_srgb(double code) { return decoded_srgb(code); }

void write_png(const std::filesystem::path& file, const HostImage& rgb, float exposure_ev) {
    if (rgb.pixel_count() == 0) fail("cannot write ", file.string(), ": the image has zero size");
    const float scale = std::exp2(exposure_ev);
    std::vector<unsigned char> bytes(rgb.pixel_count() * 3);
    for (size_t i = 0; i < rgb.pixel_count(); ++i) {
        const glm::vec3 c = rgb.rgb(i) * scale;
        const bool is_nan = std::isnan(c.x) || std::isnan(c.y) || std::isnan(c.z);
        for (int k = 0; k < 3; ++k) {
            const float code = is_nan ? float(k != 1) : srgb_from_linear(std::clamp(c[k], 0.0f, 1.0f));
            bytes[i * 3 + k] = static_cast<unsigned char>(std::lround(code * 255.0f));
        }
    }
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = rgb.extent.x;
    png.height = rgb.extent.y;
    png.format = PNG_FORMAT_RGB;
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        if (!png_image_write_to_file(&png, temporary.c_str(), 0, bytes.data(), 0, nullptr))
            fail_machine("cannot write ", file.string(), ": ", png.message);
    });
}

namespace {

/// All that encode() changes: libpng reports errors by longjmp(), which leaves no other object of a function whole.
struct PngEncoder {
    png_structp png = nullptr;
    png_infop info = nullptr;
    char error[200] = "";
    std::vector<std::byte> file;

    ~PngEncoder() { png_destroy_write_struct(&png, &info); }
};

bool encode(PngEncoder& e, glm::uvec2 extent, unsigned channels, unsigned channel_bytes, const uint8_t* codes) {
    if (setjmp(png_jmpbuf(e.png))) return false;
    png_set_write_fn(
        e.png, &e.file,
        [](png_structp png, png_bytep bytes, size_t count) {
            auto& file = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
            const auto* const begin = reinterpret_cast<const std::byte*>(bytes);
            file.insert(file.end(), begin, begin + count);
        },
        [](png_structp) {});
    png_set_IHDR(e.png, e.info, extent.x, extent.y, int(8 * channel_bytes),
                 channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(e.png, e.info, PNG_sRGB_INTENT_PERCEPTUAL);  // what programs that heed colour spaces leave as it is
    png_write_info(e.png, e.info);
    if (channel_bytes == 2 && std::endian::native == std::endian::little) png_set_swap(e.png);
    for (unsigned y = 0; y < extent.y; ++y)
        png_write_row(e.png, codes + size_t(y) * extent.x * channels * channel_bytes);
    png_write_end(e.png, e.info);
    return true;
}

}  // namespace

std::vector<std::byte> encode_png(glm::uvec2 extent, unsigned channels, unsigned channel_bytes,
                                  std::span<const uint8_t> codes) {
    PngEncoder encoder;
    encoder.png = png_create_write_struct(
        PNG_LIBPNG_VER_STRING, encoder.error,
        [](png_structp png, png_const_charp why) {
            std::snprintf(static_cast<char*>(png_get_error_ptr(png)), sizeof encoder.error, "%s", why);
            png_longjmp(png, 1);
        },
        [](png_structp, png_const_charp) {});
    encoder.info = png_create_info_struct(encoder.png);
    if (!encode(encoder, extent, channels, channel_bytes, codes.data()))
        fail_machine("an image of ", extent.x, " x ", extent.y, " texels cannot be written as PNG: ", encoder.error);
    return std::move(encoder.file);
}
