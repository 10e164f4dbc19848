#include "core/png.h"

#include "core/error.h"
#include "core/files.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <cmath>
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
