#include "core/decoded_image.h"

#include "core/error.h"
#include "core/image_format.h"
#include "core/jpeg.h"
#include "core/png.h"
#include "core/webp.h"

#include <algorithm>

DecodedImage decode_image(const EncodedImage& image, unsigned longest_side) {
    const ImageFormat format = image_format(image.bytes);
    if (format == ImageFormat::png) return decode_png(image, longest_side);
    if (format == ImageFormat::jpeg) return decode_jpeg(image, longest_side);
    if (format == ImageFormat::webp) return decode_webp(image, longest_side);
    const std::string why = why_unreadable(image.bytes, image.file, ImageUse::codes);
    fail(image.what, " cannot be decoded: it ", why.empty() ? "is neither an intact PNG nor JPEG nor WebP" : why);
}

MemoryShare reserve_memory(const EncodedImage& from, DecodedImage& image, unsigned longest_side,
                           double more_per_pixel) {
    if (std::max(image.extent.x, image.extent.y) > longest_side)
        fail(from.what, " has ", image.extent.x, " x ", image.extent.y, " pixels; allowed are sides of ", longest_side);
    const double pixels = double(image.extent.x) * double(image.extent.y);
    const std::string sized =
        from.what + " of " + std::to_string(image.extent.x) + " x " + std::to_string(image.extent.y) + " pixels";
    MemoryShare more;
    image.memory.add(pixels * double(image.texel_bytes()), sized), more.add(pixels * more_per_pixel, sized);
    return more;
}
