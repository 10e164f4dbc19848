#include "core/gpu/device.h"

Device::Device(bool validate) {
    const vk::ApplicationInfo app{.apiVersion = VK_API_VERSION_1_3};
    const char* layer = "VK_LAYER_KHRONOS_validation";
    instance = {context, vk::InstanceCreateInfo{.pApplicationInfo = &app, .enabledLayerCount = validate, .ppEnabledLayerNames = &layer}};
    gpu = std::move(instance.enumeratePhysicalDevices().front());

    const float priority = 1;
    const char* extension = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
    const vk::DeviceQueueCreateInfo queue{.queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDeviceVulkan13Features v13{.synchronization2 = true, .dynamicRendering = true, .maintenance4 = true};
    const vk::PhysicalDeviceFeatures v10{.independentBlend = true, .shaderStorageImageWriteWithoutFormat = true};
    device = {gpu, vk::DeviceCreateInfo{.pNext = &v13, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue,
                                        .enabledExtensionCount = 1, .ppEnabledExtensionNames = &extension, .pEnabledFeatures = &v10}};
    pool = {device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer}};
    commands = {device, vk::CommandBufferAllocateInfo{.commandPool = *pool, .commandBufferCount = 1}};
}

void Device::submit(const std::function<void(vk::raii::CommandBuffer&)>& record) {
    vk::raii::CommandBuffer& buffer = commands.front();
    buffer.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(buffer);
    buffer.end();
    const auto queue = device.getQueue(0, 0);
    queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*buffer});
    queue.waitIdle();
}
