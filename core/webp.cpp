#include "core/webp.h"

#include "core/error.h"

#include <webp/decode.h>

DecodedImage decode_webp(const EncodedImage& image, unsigned longest_side) {
    const std::span<const uint8_t> file = image.bytes;
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK || features.width <= 0 ||
        features.height <= 0)
        fail(image.what, " cannot be decoded: as a WebP it is cut off or broken");
    if (features.has_animation)
        fail(image.what,
             " cannot be decoded: it is a WebP with an animation, which is no texture; save a still picture");
    DecodedImage decoded;
    decoded.extent = {features.width, features.height};
    decoded.stored = std::string("8 bits, ") + (features.has_alpha ? "RGB with alpha" : "RGB") +
                     (features.format == 2 ? ", lossless" : ", lossy");
    constexpr double of_decoder = 12;  // pixels as they are coded, and caches
    const MemoryShare more = reserve_memory(image, decoded, longest_side, of_decoder);
    decoded.rgba.resize(size_t(decoded.extent.x) * decoded.extent.y * 4);
    if (!WebPDecodeRGBAInto(file.data(), file.size(), decoded.rgba.data(), decoded.rgba.size(),
                            int(decoded.extent.x) * 4))
        fail(image.what, " cannot be decoded: as a WebP it is cut off or broken");
    return decoded;
}
