#!/usr/bin/env bash
# llvmpipe, on which lavapipe runs, leaves a loop of a shader after 65535 rounds without a word: a loop that counts to 100000
# counts to 65535, and the shader goes on behind it. An outer loop shares the rounds with the loops in it: of 1000 rounds of a
# loop of 1000 rounds, 65405 are done in place of a million. A loop behind another has rounds of its own.
# For whom: who renders references, marches far, or accumulates many samples in one dispatch on lavapipe (in CI, say). The
# image looks finished and is the same in each run. Dispatches of fewer rounds each give the whole result.
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

cat >"$tmp/count.comp" <<'GLSL'
#version 450
layout(local_size_x = 1) in;
layout(binding = 0) buffer Counts { uint wanted; uint alone, after_it, outer, inner; };
layout(constant_id = 0) const uint which = 0u;
void main() {
    if (which == 0u) {
        for (uint i = 0u; i < wanted; ++i) atomicAdd(alone, 1u);
        for (uint i = 0u; i < 10u; ++i) atomicAdd(after_it, 1u);
    } else
        for (uint i = 0u; i < wanted; ++i) {
            for (uint k = 0u; k < wanted; ++k) atomicAdd(inner, 1u);
            atomicAdd(outer, 1u);
        }
}
GLSL
"$tmp/root/usr/bin/glslangValidator" -V --target-env vulkan1.2 "$tmp/count.comp" -o "$tmp/count.spv" >/dev/null

cat >"$tmp/run.cpp" <<'CPP'
#include <vulkan/vulkan.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

void check(VkResult result) {
    if (result == VK_SUCCESS) return;
    std::printf("Vulkan error %d\n", result);
    std::exit(2);
}
struct Counts { uint32_t wanted, alone, after_it, outer, inner; };

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

    VkBufferCreateInfo buffer_info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    buffer_info.size = sizeof(Counts), buffer_info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer;
    check(vkCreateBuffer(device, &buffer_info, nullptr, &buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkMemoryAllocateInfo memory_info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    memory_info.allocationSize = needs.size;  // lavapipe has one type of memory, which the host sees
    VkDeviceMemory memory;
    check(vkAllocateMemory(device, &memory_info, nullptr, &memory));
    check(vkBindBufferMemory(device, buffer, memory, 0));
    Counts* counts;
    check(vkMapMemory(device, memory, 0, sizeof(Counts), 0, reinterpret_cast<void**>(&counts)));

    std::ifstream in(arguments[1], std::ios::binary);
    const std::vector<char> code(std::istreambuf_iterator<char>(in), {});
    VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module_info.codeSize = code.size(), module_info.pCode = reinterpret_cast<const uint32_t*>(code.data());
    VkShaderModule module;
    check(vkCreateShaderModule(device, &module_info, nullptr, &module));
    const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = 1, set_info.pBindings = &binding;
    VkDescriptorSetLayout set_layout;
    check(vkCreateDescriptorSetLayout(device, &set_info, nullptr, &set_layout));
    VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.setLayoutCount = 1, layout_info.pSetLayouts = &set_layout;
    VkPipelineLayout layout;
    check(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout));
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = 1, pool_info.poolSizeCount = 1, pool_info.pPoolSizes = &size;
    VkDescriptorPool pool;
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool));
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool, allocate.descriptorSetCount = 1, allocate.pSetLayouts = &set_layout;
    VkDescriptorSet set;
    check(vkAllocateDescriptorSets(device, &allocate, &set));
    const VkDescriptorBufferInfo of_buffer{buffer, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set, write.descriptorCount = 1, write.descriptorType = size.type, write.pBufferInfo = &of_buffer;
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    VkCommandPoolCreateInfo command_pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandPool commands;
    check(vkCreateCommandPool(device, &command_pool_info, nullptr, &commands));

    const auto counted = [&](uint32_t which, uint32_t wanted) {
        const VkSpecializationMapEntry entry{0, 0, sizeof which};
        const VkSpecializationInfo constants{1, &entry, sizeof which, &which};
        VkComputePipelineCreateInfo pipeline_info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        pipeline_info.layout = layout;
        pipeline_info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, module, "main", &constants};
        VkPipeline pipeline;
        check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline));
        VkCommandBufferAllocateInfo command_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        command_info.commandPool = commands, command_info.commandBufferCount = 1;
        VkCommandBuffer command;
        check(vkAllocateCommandBuffers(device, &command_info, &command));
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(command, &begin));
        vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdBindDescriptorSets(command, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
        vkCmdDispatch(command, 1, 1, 1);
        check(vkEndCommandBuffer(command));
        *counts = {wanted, 0, 0, 0, 0};
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1, submit.pCommandBuffers = &command;
        check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
        check(vkQueueWaitIdle(queue));
        return *counts;
    };

    VkPhysicalDeviceProperties about;
    vkGetPhysicalDeviceProperties(physical, &about);
    std::printf("%s\n", about.deviceName);
    bool same = true;
    for (const uint32_t wanted : {1000u, 65534u, 65535u, 65536u, 100000u}) {
        const Counts c = counted(0, wanted);
        std::printf("a loop of %6u rounds: %u; a loop of 10 behind it: %u\n", wanted, c.alone, c.after_it);
        same = same && c.alone == (wanted < 65535 ? wanted : 65535) && c.after_it == 10;
    }
    const Counts nested = counted(1, 1000);
    std::printf("1000 rounds of a loop of 1000 rounds: %u inner and %u outer rounds\n", nested.inner, nested.outer);
    same = same && nested.inner == 65405 && nested.outer == 66;
    std::puts(same ? "as described" : "BEHAVIOUR CHANGED");
    return same ? 0 : 1;
}
CPP
g++ -std=c++17 -O1 "$tmp/run.cpp" -o "$tmp/run" -lvulkan
VK_ICD_FILENAMES=$(dpkg -L mesa-vulkan-drivers | grep 'lvp_icd.*json') "$tmp/run" "$tmp/count.spv"
