#include "core/gpu/resources.h"

#include "core/error.h"
#include "core/gpu/format.h"

#include <algorithm>
#include <cstring>
#include <utility>

void full_barrier(const vk::raii::CommandBuffer& commands) {
    const vk::MemoryBarrier2 barrier{
        .srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
        .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite};
    commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

namespace {

vk::ImageAspectFlags copied_aspect(const Image& image) {
    return image.storage->aspect & vk::ImageAspectFlagBits::eDepth ? vk::ImageAspectFlagBits::eDepth
                                                                   : vk::ImageAspectFlagBits::eColor;
}

vk::BufferImageCopy whole_mip(const Image& image) {
    return {.imageSubresource = {copied_aspect(image), image.first_mip, 0, 1},
            .imageExtent = {image.extent.x, image.extent.y, 1}};
}

/// The image that `storage.info` describes, with its views, in place of the one that it has.
void make_image(Device::Impl& gpu, ImageStorage& storage) {
    storage.image = {gpu.device, storage.info};
    storage.memory = gpu.allocate(storage.image.getMemoryRequirements(), {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
    storage.image.bindMemory(*storage.memory, 0);

    const bool is_depth = bool(storage.aspect & vk::ImageAspectFlagBits::eDepth);
    const vk::ImageAspectFlags sampled = is_depth ? vk::ImageAspectFlagBits::eDepth : storage.aspect;
    const auto view = [&](vk::ImageAspectFlags aspect, unsigned first, unsigned count) {
        return vk::raii::ImageView(gpu.device,
                                   vk::ImageViewCreateInfo{.image = *storage.image,
                                                           .viewType = vk::ImageViewType::e2D,
                                                           .format = storage.info.format,
                                                           .subresourceRange = {aspect, first, count, 0, 1}});
    };
    const unsigned mips = storage.info.mipLevels;
    storage.whole = view(sampled, 0, mips);
    storage.mips.clear();
    for (unsigned level = 0; level < mips; ++level) storage.mips.push_back(view(sampled, level, 1));
    if (is_depth) storage.attachment = view(storage.aspect, 0, 1);
    gpu.submit([&](auto& commands) {
        const vk::ImageMemoryBarrier2 barrier{.dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                              .newLayout = vk::ImageLayout::eGeneral,
                                              .image = *storage.image,
                                              .subresourceRange = {storage.aspect, 0, mips, 0, 1}};
        commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
    });
}

void copy_image(Device::Impl& gpu, const vk::raii::Image& from, const ImageStorage& to) {
    std::vector<vk::ImageCopy> copies;
    for (unsigned level = 0; level < to.info.mipLevels; ++level) {
        const vk::Extent3D extent{std::max(to.info.extent.width >> level, 1u),
                                  std::max(to.info.extent.height >> level, 1u), 1};
        const vk::ImageSubresourceLayers whole{to.aspect, level, 0, 1};
        copies.push_back({.srcSubresource = whole, .dstSubresource = whole, .extent = extent});
    }
    gpu.submit([&](auto& commands) {
        full_barrier(commands);
        commands.copyImage(*from, vk::ImageLayout::eGeneral, *to.image, vk::ImageLayout::eGeneral, copies);
        full_barrier(commands);
    });
}

}  // namespace

std::shared_ptr<ImageStorage> create_image(Device::Impl& gpu, Format format, glm::uvec2 extent, unsigned mips) {
    using Usage = vk::ImageUsageFlagBits;
    if (std::max(extent.x, extent.y) > gpu.largest_side)
        fail_machine("an image of ", extent.x, "x", extent.y, " pixels is larger than any of the Vulkan device '",
                     gpu.info.name, "', whose sides have ", gpu.largest_side, " at most: choose a smaller size");
    auto storage = std::make_shared<ImageStorage>();
    storage->aspect = aspect_of(format);
    const vk::Format vk_format = vulkan_format(format);
    storage->features = gpu.gpu.getFormatProperties(vk_format).optimalTilingFeatures;
    storage->info = {.imageType = vk::ImageType::e2D,
                     .format = vk_format,
                     .extent = {extent.x, extent.y, 1},
                     .mipLevels = mips,
                     .arrayLayers = 1,
                     .usage = Usage::eTransferSrc | Usage::eTransferDst | Usage::eSampled};
    if (storage->aspect & vk::ImageAspectFlagBits::eDepth) {
        storage->info.usage |= Usage::eDepthStencilAttachment;
        if (!(storage->features & vk::FormatFeatureFlagBits::eDepthStencilAttachment))
            fail_machine("the Vulkan device '", gpu.info.name, "' has no depth format ", vk::to_string(vk_format),
                         "; choose another depth format");
    }
    return storage;
}

void allow_use(Device::Impl& gpu, const Image& image, vk::ImageUsageFlagBits use) {
    ImageStorage& storage = *image.storage;
    const bool is_made = *storage.image != vk::Image();
    if (is_made && (storage.info.usage & use)) return;
    if (is_made && gpu.flush_recording) gpu.flush_recording();  // it may use the one that is there
    ImageStorage made;  // beside the one that is there, which stays if there is no memory for two
    made.info = storage.info, made.features = storage.features, made.aspect = storage.aspect;
    made.info.usage |= use;
    made.is_written = storage.is_written;
    make_image(gpu, made);
    if (is_made && made.is_written) copy_image(gpu, storage.image, made);
    std::swap(storage, made);
}

std::shared_ptr<BufferStorage> create_buffer(Device::Impl& gpu, size_t bytes) {
    using Usage = vk::BufferUsageFlagBits;
    auto storage = std::make_shared<BufferStorage>();
    storage->buffer = DeviceBuffer(gpu, bytes,
                                   Usage::eStorageBuffer | Usage::eIndirectBuffer | Usage::eIndexBuffer |
                                       Usage::eTransferSrc | Usage::eTransferDst,
                                   false);
    gpu.submit([&](auto& commands) {
        commands.fillBuffer(*storage->buffer.buffer, 0, VK_WHOLE_SIZE, 0);
        full_barrier(commands);
    });
    return storage;
}

void upload_texels(Device::Impl& gpu, const Image& image, std::span<const std::byte> texels) {
    const DeviceBuffer staging(gpu, texels.size(), vk::BufferUsageFlagBits::eTransferSrc, true);
    std::memcpy(staging.data, texels.data(), texels.size());
    allow_use(gpu, image, vk::ImageUsageFlagBits::eTransferDst);
    gpu.submit([&](auto& commands) {
        full_barrier(commands);
        commands.copyBufferToImage(*staging.buffer, *image.storage->image, vk::ImageLayout::eGeneral, whole_mip(image));
        full_barrier(commands);
    });
    image.storage->is_written = true;
}

std::vector<std::byte> download_texels(Device::Impl& gpu, const Image& image) {
    const size_t size = size_t(image.extent.x) * image.extent.y * facts_of(image.format).bytes;
    const DeviceBuffer staging(gpu, size, vk::BufferUsageFlagBits::eTransferDst, true);
    allow_use(gpu, image, vk::ImageUsageFlagBits::eTransferSrc);
    gpu.submit([&](auto& commands) {
        full_barrier(commands);
        commands.copyImageToBuffer(*image.storage->image, vk::ImageLayout::eGeneral, *staging.buffer, whole_mip(image));
        full_barrier(commands);
    });
    return {staging.data, staging.data + size};
}

void upload_bytes(Device::Impl& gpu, const Buffer& buffer, std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    const DeviceBuffer staging(gpu, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, true);
    std::memcpy(staging.data, bytes.data(), bytes.size());
    gpu.submit([&](auto& commands) {
        full_barrier(commands);
        commands.copyBuffer(*staging.buffer, *buffer.storage->buffer.buffer, vk::BufferCopy{.size = bytes.size()});
        full_barrier(commands);
    });
}

std::vector<std::byte> download_bytes(Device::Impl& gpu, const Buffer& buffer) {
    const DeviceBuffer staging(gpu, buffer.size, vk::BufferUsageFlagBits::eTransferDst, true);
    gpu.submit([&](auto& commands) {
        full_barrier(commands);
        commands.copyBuffer(*buffer.storage->buffer.buffer, *staging.buffer, vk::BufferCopy{.size = buffer.size});
        full_barrier(commands);
    });
    return {staging.data, staging.data + buffer.size};
}
