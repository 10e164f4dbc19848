#include "core/gpu/image.h"

#include "core/gpu/device_impl.h"
#include "core/gpu/format.h"

Image Image::mip(unsigned level) const {
    Image view = *this;
    view.first_mip = first_mip + level;
    view.mips = 1;
    view.extent = max(extent >> level, 1u);
    return view;
}

Image Image::as(std::string shader_name) const {
    Image view = *this;
    view.name = std::move(shader_name);
    return view;
}

Buffer Buffer::as(std::string shader_name) const {
    Buffer view = *this;
    view.name = std::move(shader_name);
    return view;
}

uint64_t bytes_of(const Image& image) {
    uint64_t texels = 0;
    for (unsigned level = 0; level < image.mips; ++level) {
        const Image mip = image.mip(level);
        texels += uint64_t(mip.extent.x) * mip.extent.y;
    }
    return texels * facts_of(image.format).bytes;
}

WholeImage whole_of(const Image& image) {
    const vk::ImageCreateInfo& info = image.storage->info;
    return {{info.extent.width, info.extent.height}, info.mipLevels};
}
