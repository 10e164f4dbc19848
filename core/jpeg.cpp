#include "core/jpeg.h"

#include <turbojpeg.h>
#include <memory>

std::optional<std::vector<uint8_t>> decode_jpeg_rgba(std::span<const uint8_t> file, glm::uvec2 extent) {
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
    int width = 0, height = 0, subsampling = 0, color_space = 0;
    if (!decoder ||
        tjDecompressHeader3(decoder.get(), file.data(), file.size(), &width, &height, &subsampling, &color_space) !=
            0 ||
        glm::ivec2(width, height) != glm::ivec2(extent))
        return {};
    std::vector<uint8_t> rgba(size_t(width) * size_t(height) * 4);
    // Without a limit on the scans, a few kilobytes of them decode the whole image as many times.
    constexpr int flags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING;
    if (tjDecompress2(decoder.get(), file.data(), file.size(), rgba.data(), width, 0, height, TJPF_RGBA, flags) != 0)
        return {};
    return rgba;
}
