#pragma once
#include "core/gpu/device_impl.h"
#include "core/host_image.h"

#include <span>

// Images and buffers on the device, and their way there and back. All images stay in the general layout: ssrlab
// compares algorithms, and one layout keeps passes free of transitions.

/// An image that can be copied and sampled; a depth image also serves for depth tests.
std::shared_ptr<ImageStorage> create_image(Device::Impl& gpu, Format format, glm::uvec2 extent, unsigned mips);

/// Lets shaders also store to an image, or draw to it. Drivers compress such images less (Mesa's radv:
/// radv_use_dcc_for_image_early() in src/amd/vulkan/radv_image.c). An image therefore allows only uses that passes have
/// asked for; a new use makes the image again, with its content.
void allow_use(Device::Impl& gpu, const Image& image, vk::ImageUsageFlagBits use);

std::shared_ptr<BufferStorage> create_buffer(Device::Impl& gpu, size_t bytes);

void upload_texels(Device::Impl& gpu, const Image& image, std::span<const std::byte> texels);
std::vector<std::byte> download_texels(Device::Impl& gpu, const Image& image);
void upload_bytes(Device::Impl& gpu, const Buffer& buffer, std::span<const std::byte> bytes);
std::vector<std::byte> download_bytes(Device::Impl& gpu, const Buffer& buffer);

/// Everything written before is seen by everything after: one global barrier.
void full_barrier(const vk::raii::CommandBuffer& commands);
