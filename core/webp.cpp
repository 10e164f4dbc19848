#include "core/webp.h"

#include <webp/decode.h>
#include <string_view>

bool is_webp(std::span<const uint8_t> file) {
    const auto has = [&](size_t at, std::string_view mark) {
        for (size_t i = 0; i < mark.size(); ++i)
            if (file[at + i] != uint8_t(mark[i])) return false;
        return true;
    };
    return file.size() >= 12 && has(0, "RIFF") && has(8, "WEBP");
}

glm::uvec2 webp_extent(std::span<const uint8_t> file) {
    WebPBitstreamFeatures features;
    const bool fits = is_webp(file) && WebPGetFeatures(file.data(), file.size(), &features) == VP8_STATUS_OK &&
                      !features.has_animation && features.width > 0 && features.height > 0;
    return fits ? glm::uvec2(features.width, features.height) : glm::uvec2(0, 0);
}

std::optional<std::vector<uint8_t>> decode_webp_rgba(std::span<const uint8_t> file, glm::uvec2 extent) {
    if (extent.x == 0 || extent.y == 0 || webp_extent(file) != extent) return {};
    std::vector<uint8_t> rgba(size_t(extent.x) * extent.y * 4);
    const bool is_whole =
        WebPDecodeRGBAInto(file.data(), file.size(), rgba.data(), rgba.size(), int(extent.x) * 4) != nullptr;
    return is_whole ? std::optional(std::move(rgba)) : std::nullopt;
}
