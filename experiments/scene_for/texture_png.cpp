#include "experiments/scene_for/texture_png.h"

#include "core/error.h"

#include <png.h>
#include <algorithm>

std::vector<std::byte> texture_png(const Texture& texture) {
    const std::vector<uint8_t>& rgba = *texture.rgba;
    bool is_opaque = true;
    for (size_t i = 3; i < rgba.size(); i += 4) is_opaque &= rgba[i] == 255;
    std::vector<uint8_t> codes = rgba;
    if (is_opaque)
        for (size_t i = 0; i < rgba.size() / 4; ++i) std::copy_n(&rgba[i * 4], 3, &codes[i * 3]);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = texture.extent.x, png.height = texture.extent.y;
    png.format = is_opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::vector<std::byte> file(size);
    if (!png_image_write_to_memory(&png, file.data(), &size, 0, codes.data(), 0, nullptr))
        fail("texture '", texture.name, "' cannot be written as PNG: ", png.message);
    file.resize(size);
    return file;
}
