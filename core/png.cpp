#include "core/png.h"

#include "core/error.h"
#include "core/files.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <png.h>
#include <span>

float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

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

HostImage read_png_codes(const std::filesystem::path& file) {
    check_regular_file(file);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&png, file.c_str())) fail("cannot read ", file.string(), " as PNG: ", png.message);
    png.format = PNG_FORMAT_RGB;
    constexpr double bytes_per_pixel = 3 * (sizeof(unsigned char) + sizeof(float));
    MemoryShare memory;
    try {
        memory.add(double(png.width) * double(png.height) * bytes_per_pixel,
                   file.string() + ": its image of " + std::to_string(png.width) + " x " + std::to_string(png.height) + " pixels");
    } catch (...) {
        png_image_free(&png);
        throw;
    }
    std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(png));
    if (!png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr)) fail("cannot read ", file.string(), " as PNG: ", png.message);
    HostImage image({png.width, png.height}, 3);
    std::ranges::transform(bytes, image.values.begin(), [](unsigned char code) { return float(code) / 255.0f; });
    return image;
}

namespace {

/// All that decode() changes: libpng reports errors by longjmp(), which leaves no other object of a function whole.
struct PngDecoder {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const uint8_t> rest;
    unsigned width = 0, height = 0, bytes_per_pixel = 0;
    std::vector<uint8_t> codes;  ///< RGBA of 8 bits, or of 16, the higher byte first

    ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

void hand_out(png_structp png, png_bytep to, size_t count) {
    auto& rest = static_cast<PngDecoder*>(png_get_io_ptr(png))->rest;
    if (rest.size() < count) png_error(png, "truncated");
    std::memcpy(to, rest.data(), count);
    rest = rest.subspan(count);
}

/// Colours are expanded, and not converted: what the file says of its gamma is for glTF not to be used (glTF 2.0, section
/// 3.8.3).
bool decode(PngDecoder& d) {
    if (setjmp(png_jmpbuf(d.png))) return false;
    png_set_read_fn(d.png, &d, hand_out);
    png_read_info(d.png, d.info);
    png_set_expand(d.png);
    png_set_gray_to_rgb(d.png);
    png_set_add_alpha(d.png, 0xFFFF, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(d.png);
    png_read_update_info(d.png, d.info);
    d.width = png_get_image_width(d.png, d.info), d.height = png_get_image_height(d.png, d.info);
    d.bytes_per_pixel = 4 * png_get_bit_depth(d.png, d.info) / 8;
    const size_t row = size_t(d.width) * d.bytes_per_pixel;
    if (png_get_rowbytes(d.png, d.info) != row) return false;
    d.codes.resize(row * d.height);
    for (int pass = 0; pass < passes; ++pass)
        for (unsigned y = 0; y < d.height; ++y) png_read_row(d.png, d.codes.data() + y * row, nullptr);
    png_read_end(d.png, nullptr);
    return true;
}

}  // namespace

std::optional<std::vector<uint8_t>> decode_png_rgba(std::span<const uint8_t> file) {
    PngDecoder decoder;
    decoder.rest = file;
    decoder.png = png_create_read_struct(
        PNG_LIBPNG_VER_STRING, nullptr, [](png_structp png, png_const_charp) { png_longjmp(png, 1); },
        [](png_structp, png_const_charp) {});
    decoder.info = png_create_info_struct(decoder.png);
    if (!decode(decoder)) return {};
    if (decoder.bytes_per_pixel == 4) return std::move(decoder.codes);
    std::vector<uint8_t> rounded(decoder.codes.size() / 2);
    for (size_t i = 0; i < rounded.size(); ++i) {
        const unsigned code = unsigned(decoder.codes[2 * i]) << 8 | decoder.codes[2 * i + 1];
        rounded[i] = uint8_t((code * 255u + 32767u) / 65535u);
    }
    return rounded;
}
