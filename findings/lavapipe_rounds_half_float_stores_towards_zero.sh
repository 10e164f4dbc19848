#!/usr/bin/env bash
# lavapipe rounds what a shader stores into an image of half floats towards zero: nearly a whole unit in the last place is
# dropped, and 70000 becomes 65504. vkCmdClearColorImage does the same. packHalf2x16(), in the same shader, rounds the same
# numbers to the nearest half, and 70000 to infinity. Vulkan leaves the direction of such stores open.
# For whom: who keeps histories in rgba16f on lavapipe (in CI, say), or stores half floats once by an image and once packed.
# A history that takes 0.05 of a new value of 1 in each frame stops at 0.9907; rounded to the nearest it would at 0.9956.
# Versions: mesa-vulkan-drivers 22.3.6 (llvmpipe, on x86-64), glslang 12.0.0 (Debian 12).
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
need() {  # NAME VERSION: installs that version unless it is there
    [ "$(dpkg-query -W -f='${Version}' "$1" 2>/dev/null)" = "$2" ] ||
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$1=$2" >/dev/null
}
apt-get update -qq
need mesa-vulkan-drivers 22.3.6-1+deb12u2
need libvulkan-dev 1.3.239.0-1
(cd "$tmp" && apt-get -o APT::Sandbox::User=root download -qq glslang-tools=12.0.0-2 >/dev/null && dpkg -x glslang-tools*.deb root)

cat >"$tmp/store.comp" <<'GLSL'
#version 450
layout(local_size_x = 1) in;
layout(binding = 0) buffer Values { vec4 stored; vec4 history; uint packed[2]; };
layout(binding = 1, rgba16f) uniform image2D picture;
void main() {
    imageStore(picture, ivec2(0, 0), stored);
    packed[0] = packHalf2x16(stored.xy);
    packed[1] = packHalf2x16(stored.zw);
    imageStore(picture, ivec2(1, 0), vec4(0));
    for (int frame = 0; frame < 1000; ++frame)
        imageStore(picture, ivec2(1, 0), mix(imageLoad(picture, ivec2(1, 0)), vec4(1), 0.05));
    history = imageLoad(picture, ivec2(1, 0));
}
GLSL
"$tmp/root/usr/bin/glslangValidator" -V --target-env vulkan1.2 "$tmp/store.comp" -o "$tmp/store.spv" >/dev/null

cat >"$tmp/run.cpp" <<'CPP'
#include <vulkan/vulkan.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

void check(VkResult result) {
    if (result == VK_SUCCESS) return;
    std::printf("Vulkan error %d\n", result);
    std::exit(2);
}
uint32_t memory_type(VkPhysicalDevice physical, uint32_t allowed) {  // lavapipe has one
    VkPhysicalDeviceMemoryProperties memories;
    vkGetPhysicalDeviceMemoryProperties(physical, &memories);
    const VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    for (uint32_t i = 0; i < memories.memoryTypeCount; ++i)
        if ((allowed >> i & 1) && (memories.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    std::exit(2);
}
int main(int, char** arguments) {
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo instance_info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instance_info.pApplicationInfo = &app;
    VkInstance instance;
    check(vkCreateInstance(&instance_info, nullptr, &instance));
    VkPhysicalDevice physical;
    uint32_t one = 1;
    vkEnumeratePhysicalDevices(instance, &one, &physical);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueCount = 1, queue_info.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    device_info.queueCreateInfoCount = 1, device_info.pQueueCreateInfos = &queue_info;
    VkDevice device;
    check(vkCreateDevice(physical, &device_info, nullptr, &device));
    VkQueue queue;
    vkGetDeviceQueue(device, 0, 0, &queue);

    // Between 1 and its neighbour 1 + 2^-10; the same of the other sign; beyond 65504, the greatest half; and halfway.
    const float given[4] = {1 + 0x1.fep-11f, -1 - 0x1.fep-11f, 70000, 1 + 0x1p-11f};
    struct Values { float stored[4], history[4]; uint32_t packed[2]; uint16_t pixels[3][4]; };
    VkBufferCreateInfo buffer_info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    buffer_info.size = sizeof(Values), buffer_info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer;
    check(vkCreateBuffer(device, &buffer_info, nullptr, &buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkMemoryAllocateInfo memory_info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    memory_info.allocationSize = needs.size, memory_info.memoryTypeIndex = memory_type(physical, needs.memoryTypeBits);
    VkDeviceMemory memory, image_memory;
    check(vkAllocateMemory(device, &memory_info, nullptr, &memory));
    check(vkBindBufferMemory(device, buffer, memory, 0));
    Values* values;
    check(vkMapMemory(device, memory, 0, sizeof(Values), 0, reinterpret_cast<void**>(&values)));
    std::memcpy(values->stored, given, sizeof given);

    VkImageCreateInfo image_info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    image_info.imageType = VK_IMAGE_TYPE_2D, image_info.format = VK_FORMAT_R16G16B16A16_SFLOAT, image_info.extent = {3, 1, 1};
    image_info.mipLevels = image_info.arrayLayers = 1, image_info.samples = VK_SAMPLE_COUNT_1_BIT;
    image_info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImage image;
    check(vkCreateImage(device, &image_info, nullptr, &image));
    vkGetImageMemoryRequirements(device, image, &needs);
    memory_info.allocationSize = needs.size, memory_info.memoryTypeIndex = memory_type(physical, needs.memoryTypeBits);
    check(vkAllocateMemory(device, &memory_info, nullptr, &image_memory));
    check(vkBindImageMemory(device, image, image_memory, 0));
    const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageViewCreateInfo view_info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view_info.image = image, view_info.viewType = VK_IMAGE_VIEW_TYPE_2D, view_info.format = image_info.format, view_info.subresourceRange = whole;
    VkImageView view;
    check(vkCreateImageView(device, &view_info, nullptr, &view));

    std::ifstream in(arguments[1], std::ios::binary);
    const std::vector<char> code(std::istreambuf_iterator<char>(in), {});
    VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module_info.codeSize = code.size(), module_info.pCode = reinterpret_cast<const uint32_t*>(code.data());
    VkShaderModule module;
    check(vkCreateShaderModule(device, &module_info, nullptr, &module));
    const VkDescriptorSetLayoutBinding bindings[2] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
    VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = 2, set_info.pBindings = bindings;
    VkDescriptorSetLayout set_layout;
    check(vkCreateDescriptorSetLayout(device, &set_info, nullptr, &set_layout));
    VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.setLayoutCount = 1, layout_info.pSetLayouts = &set_layout;
    VkPipelineLayout layout;
    check(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout));
    VkComputePipelineCreateInfo pipeline_info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    pipeline_info.layout = layout;
    pipeline_info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, module, "main", nullptr};
    VkPipeline pipeline;
    check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline));
    const VkDescriptorPoolSize sizes[2] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = 1, pool_info.poolSizeCount = 2, pool_info.pPoolSizes = sizes;
    VkDescriptorPool pool;
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool));
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool, allocate.descriptorSetCount = 1, allocate.pSetLayouts = &set_layout;
    VkDescriptorSet set;
    check(vkAllocateDescriptorSets(device, &allocate, &set));
    const VkDescriptorBufferInfo of_buffer{buffer, 0, VK_WHOLE_SIZE};
    const VkDescriptorImageInfo of_image{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
    VkWriteDescriptorSet writes[2] = {{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}};
    for (int i = 0; i < 2; ++i) writes[i].dstSet = set, writes[i].dstBinding = i, writes[i].descriptorCount = 1, writes[i].descriptorType = bindings[i].descriptorType;
    writes[0].pBufferInfo = &of_buffer, writes[1].pImageInfo = &of_image;
    vkUpdateDescriptorSets(device, 2, writes, 0, nullptr);

    VkCommandPoolCreateInfo command_pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandPool commands;
    check(vkCreateCommandPool(device, &command_pool_info, nullptr, &commands));
    VkCommandBufferAllocateInfo command_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    command_info.commandPool = commands, command_info.commandBufferCount = 1;
    VkCommandBuffer command;
    check(vkAllocateCommandBuffers(device, &command_info, &command));
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(command, &begin));
    const auto wait = [&](VkImageLayout before) {
        VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
        barrier.srcAccessMask = barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.oldLayout = before, barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL, barrier.image = image, barrier.subresourceRange = whole;
        vkCmdPipelineBarrier(command, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    };
    wait(VK_IMAGE_LAYOUT_UNDEFINED);
    VkClearColorValue color;
    std::memcpy(color.float32, given, sizeof given);
    vkCmdClearColorImage(command, image, VK_IMAGE_LAYOUT_GENERAL, &color, 1, &whole);  // the last pixel keeps it
    wait(VK_IMAGE_LAYOUT_GENERAL);
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(command, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    vkCmdDispatch(command, 1, 1, 1);
    wait(VK_IMAGE_LAYOUT_GENERAL);
    VkBufferImageCopy region{};
    region.bufferOffset = offsetof(Values, pixels), region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, region.imageExtent = {3, 1, 1};
    vkCmdCopyImageToBuffer(command, image, VK_IMAGE_LAYOUT_GENERAL, buffer, 1, &region);
    check(vkEndCommandBuffer(command));
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1, submit.pCommandBuffers = &command;
    check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
    check(vkQueueWaitIdle(queue));

    VkPhysicalDeviceProperties about;
    vkGetPhysicalDeviceProperties(physical, &about);
    std::printf("%s\n%-28s %-10s %-12s %s\n", about.deviceName, "value", "imageStore", "packHalf2x16", "vkCmdClearColorImage");
    for (int i = 0; i < 4; ++i) {
        const uint16_t packed = uint16_t(values->packed[i / 2] >> 16 * (i % 2));
        std::printf("%-28.17g %04x       %04x         %04x\n", double(given[i]), values->pixels[0][i], packed, values->pixels[2][i]);
    }
    double nearest = 0;  // what rounding to 11 digits of the nearest makes of the history
    for (int frame = 0, exponent = 0; frame < 1000; ++frame) {
        const double next = nearest + (1 - nearest) * double(0.05f);
        std::frexp(next, &exponent);
        nearest = std::ldexp(std::nearbyint(std::ldexp(next, 11 - exponent)), exponent - 11);
    }
    std::printf("after 1000 frames of mix(history, 1, 0.05): %.9g; by rounding to the nearest: %.9g\n", double(values->history[0]), nearest);
    const uint16_t down[4] = {0x3c00, 0xbc00, 0x7bff, 0x3c00}, near[4] = {0x3c01, 0xbc01, 0x7c00, 0x3c00};
    bool same = values->history[0] == 0.990722656f;
    for (int i = 0; i < 4; ++i)
        same = same && values->pixels[0][i] == down[i] && values->pixels[2][i] == down[i] && uint16_t(values->packed[i / 2] >> 16 * (i % 2)) == near[i];
    std::puts(same ? "as described" : "BEHAVIOUR CHANGED");
    return same ? 0 : 1;
}
CPP
g++ -std=c++17 -O1 "$tmp/run.cpp" -o "$tmp/run" -lvulkan
VK_ICD_FILENAMES=$(dpkg -L mesa-vulkan-drivers | grep 'lvp_icd.*json') "$tmp/run" "$tmp/store.spv"
