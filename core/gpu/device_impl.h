#pragma once
#include "core/gpu/device.h"

#define VULKAN_HPP_NO_CONSTRUCTORS
#include <functional>
#include <mutex>
#include <vulkan/vulkan_raii.hpp>

// The Vulkan side of Device, seen by core/gpu only: vulkan_raii.hpp costs seconds per source file.

vk::Format vulkan_format(Format format);
vk::ImageAspectFlags aspect_of(Format format);

/// Features that techniques or core/gpu need and the device lacks: the name in Vulkan and the purpose of each.
std::vector<std::string> missing_features(const vk::PhysicalDeviceFeatures& v10,
                                          const vk::PhysicalDeviceVulkan13Features& v13,
                                          const std::vector<vk::ExtensionProperties>& extensions);

/// The features that are enabled on every device. Reads beyond an image give zeros, as the Direct3D originals of
/// several techniques expect.
struct NeededFeatures {
    vk::PhysicalDeviceVulkan13Features v13;
    vk::PhysicalDeviceVulkan12Features v12;  ///< also optional features, enabled where the device has them
    vk::PhysicalDeviceFeatures v10;
};
NeededFeatures needed_features();

/// What the debug callback fills; its address must not change.
struct ValidationLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

struct Device::Impl {
    vk::raii::Context context;
    ValidationLog log;
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
    vk::raii::PhysicalDevice gpu{nullptr};
    DeviceInfo info;
    uint32_t queue_family = 0;
    float nanoseconds_per_tick = 1;  ///< of time stamps
    bool has_doubles = false;        ///< in shaders
    bool has_half_floats = false;    ///< in shaders, as numbers to calculate with
    bool has_statistics = false;     ///< counts invocations
    uint32_t timestamp_bits = 0;     ///< 0: the queue cannot write time stamps
    uint32_t largest_side = 0;       ///< of an image, pixels
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    vk::raii::CommandPool pool{nullptr};
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence fence{nullptr};
    std::shared_ptr<class PipelineCache> pipelines;  ///< see PipelineCache::of()
    std::shared_ptr<struct WatchedBuffer> watched;   ///< once a pass was watched

    /// Submits what a pass_list has recorded. Other pass_lists call it before they start, so that work keeps its order.
    std::function<void()> flush_recording;

    /// Memory of a type with all `required` flags, and with all `preferred` ones if such a type exists.
    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags required,
                                    vk::MemoryPropertyFlags preferred = {});

    /// Records, submits and waits.
    void submit(const std::function<void(vk::raii::CommandBuffer&)>& record);
    void submit_and_wait(const vk::raii::CommandBuffer& ended, const vk::raii::Fence& fence);
};

/// A buffer with memory of its own; `data` is mapped if it is visible to the host.
struct DeviceBuffer {
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    std::byte* data = nullptr;

    DeviceBuffer() = default;
    DeviceBuffer(Device::Impl& gpu, size_t size, vk::BufferUsageFlags usage, bool is_host_visible);
};

/// The storage of an image, made at its first use (allow_use()).
struct ImageStorage {
    vk::ImageCreateInfo info;         ///< its uses grow
    vk::FormatFeatureFlags features;  ///< what the device can do with the format
    vk::raii::Image image{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::ImageView whole{nullptr};       ///< all mips; for sampling: the depth aspect only
    std::vector<vk::raii::ImageView> mips;    ///< for sampling and storage
    vk::raii::ImageView attachment{nullptr};  ///< depth and stencil together; empty for colours
    vk::ImageAspectFlags aspect;
    bool is_written = false;  ///< by a pass, a clear or an upload
};

struct BufferStorage {
    DeviceBuffer buffer;
};
