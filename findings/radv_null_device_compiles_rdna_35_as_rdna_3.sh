#!/usr/bin/env bash
# RADV, Mesa's Vulkan driver of AMD GPUs, compiles for a chip that is not there if RADV_FORCE_FAMILY names the chip. For the
# chips of RDNA 3.5 (gfx1150 to gfx1153) the shaders here become the code of RDNA 3 (navi31), with the same size and CRC32.
# That code has no scalar float instruction. RDNA 3.5 has them: LLVM's assembler takes s_add_f32 for gfx1150, and RADV uses
# them for RDNA 4 (gfx1201) in the same shaders. The device calls itself GFX1150, and no warning says whose code it is.
# The reason is in Mesa's radv_null_winsys.c, which takes each family from navi31 to below gfx1200 for GFX11, not GFX11_5.
# For whom: who compares instructions, code sizes or registers of chips without the chips: RDNA 3.5 looks like RDNA 3. Chips
# that are there are opened by other code (radv_amdgpu_winsys.c), which this script does not run.
# Versions: mesa-vulkan-drivers 25.0.7-2~bpo12+1 (bookworm-backports), llvm-19 19.1.7, glslang 12.0.0 (Debian 12). It needs gcc.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
mkdir "$tmp"/{lists,cache,debs}
printf 'deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian %s main\n' \
    bookworm bookworm-backports >"$tmp/sources.list"
printf '#clear APT::Update::%s;\n' Pre-Invoke Post-Invoke Post-Invoke-Success >"$tmp/apt.conf"
apt=(apt-get -qq -c "$tmp/apt.conf" -o APT::Sandbox::User="$(id -un)" -o Dir::Cache="$tmp/cache"
    -o Dir::Etc::sourcelist="$tmp/sources.list" -o Dir::Etc::sourceparts=/dev/null
    -o Dir::State::lists="$tmp/lists" -o Dir::State::status=/dev/null)
"${apt[@]}" update
(cd "$tmp/debs" && "${apt[@]}" download mesa-vulkan-drivers=25.0.7-2~bpo12+1 libdrm2=2.4.123-1~bpo12+1 \
    libdrm-amdgpu1=2.4.123-1~bpo12+1 llvm-19=1:19.1.7-3~deb12u1 libllvm19=1:19.1.7-3~deb12u1 glslang-tools=12.0.0-2 \
    libvulkan-dev=1.3.239.0-1 libvulkan1=1.3.239.0-1 libllvm15 libz3-4 libicu72 libxml2 libedit2 libbsd0 libelf1 libexpat1 \
    libwayland-client0 libx11-xcb1 libxcb1 libxau6 libxdmcp6 libxshmfence1 libxcb-{dri3-0,present0,randr0,shm0,sync1,xfixes0})
for package in "$tmp"/debs/*.deb; do dpkg -x "$package" "$tmp/root"; done
usr="$tmp/root/usr"

cat >"$tmp/compile.c" <<'C'
#include <stdio.h>
#include <stdlib.h>
#include <vulkan/vulkan.h>
#define TYPE(name) .sType = VK_STRUCTURE_TYPE_##name
#define TRY(call) do if ((call) != VK_SUCCESS) { puts("failed: " #call); exit(2); } while (0)
#define FUNCTION(name) PFN_##name name = (PFN_##name)vkGetDeviceProcAddr(device, #name)
int main(void) {  // of the SPIR-V on the standard input: the device's name, the numbers and texts that the driver gives
    static uint32_t code[1 << 16];
    VkInstance instance; VkPhysicalDevice chip; VkPhysicalDeviceProperties properties; VkDevice device;
    const size_t size = fread(code, 1, sizeof code, stdin);
    TRY(vkCreateInstance(&(VkInstanceCreateInfo){TYPE(INSTANCE_CREATE_INFO), .pApplicationInfo =
        &(VkApplicationInfo){TYPE(APPLICATION_INFO), .apiVersion = VK_API_VERSION_1_3}}, NULL, &instance));
    TRY(vkEnumeratePhysicalDevices(instance, &(uint32_t){1}, &chip));
    vkGetPhysicalDeviceProperties(chip, &properties);
    VkPhysicalDeviceVulkan12Features pointers = {TYPE(PHYSICAL_DEVICE_VULKAN_1_2_FEATURES), .bufferDeviceAddress = VK_TRUE};
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR features = {
        TYPE(PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR), &pointers, .pipelineExecutableInfo = VK_TRUE};
    VkDeviceQueueCreateInfo queue = {TYPE(DEVICE_QUEUE_CREATE_INFO), .queueCount = 1, .pQueuePriorities = &(float){1}};
    TRY(vkCreateDevice(chip, &(VkDeviceCreateInfo){TYPE(DEVICE_CREATE_INFO), .pNext = &features, .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue, .enabledExtensionCount = 1,
        .ppEnabledExtensionNames = &(const char*){"VK_KHR_pipeline_executable_properties"}}, NULL, &device));
    VkPipelineLayoutCreateInfo inputs = {TYPE(PIPELINE_LAYOUT_CREATE_INFO), .pushConstantRangeCount = 1,
        .pPushConstantRanges = &(VkPushConstantRange){VK_SHADER_STAGE_COMPUTE_BIT, 0, 24}};
    VkComputePipelineCreateInfo wanted = {TYPE(COMPUTE_PIPELINE_CREATE_INFO),
        .stage = {TYPE(PIPELINE_SHADER_STAGE_CREATE_INFO), .stage = VK_SHADER_STAGE_COMPUTE_BIT, .pName = "main"},
        .flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR};
    TRY(vkCreatePipelineLayout(device, &inputs, NULL, &wanted.layout));
    VkShaderModuleCreateInfo shader = {TYPE(SHADER_MODULE_CREATE_INFO), .codeSize = size, .pCode = code};
    TRY(vkCreateShaderModule(device, &shader, NULL, &wanted.stage.module));
    VkPipelineExecutableInfoKHR done = {TYPE(PIPELINE_EXECUTABLE_INFO_KHR)};
    TRY(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &wanted, NULL, &done.pipeline));
    FUNCTION(vkGetPipelineExecutableStatisticsKHR);
    FUNCTION(vkGetPipelineExecutableInternalRepresentationsKHR);
    VkPipelineExecutableStatisticKHR numbers[64] = {0};
    VkPipelineExecutableInternalRepresentationKHR texts[8];
    uint32_t number_count = 64, text_count = 8;
    for (int i = 0; i < 64; ++i) numbers[i].sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    for (int i = 0; i < 8; ++i) texts[i] = (VkPipelineExecutableInternalRepresentationKHR){
        TYPE(PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR), .dataSize = 1 << 16, .pData = calloc(1 << 16, 1)};
    TRY(vkGetPipelineExecutableStatisticsKHR(device, &done, &number_count, numbers));
    TRY(vkGetPipelineExecutableInternalRepresentationsKHR(device, &done, &text_count, texts));
    puts(properties.deviceName);
    for (uint32_t i = 0; i < number_count; ++i) printf("%s = %u\n", numbers[i].name, (uint32_t)numbers[i].value.u64);
    for (uint32_t i = 0; i < text_count; ++i) printf("%s\n%s\n", texts[i].name, (const char*)texts[i].pData);
}
C
gcc -I"$usr/include" "$tmp/compile.c" -o "$tmp/compile" "$usr/lib/x86_64-linux-gnu/libvulkan.so.1"
export LD_LIBRARY_PATH="$usr/lib/x86_64-linux-gnu:$tmp/root/lib/x86_64-linux-gnu"
export VK_ICD_FILENAMES="$usr/share/vulkan/icd.d/radeon_icd.json" MESA_SHADER_CACHE_DISABLE=1
is_same=true
takes() { echo "s_add_f32 s0, s1, s2" | "$usr/lib/llvm-19/bin/llvm-mc" -triple=amdgcn -mcpu="$1" >/dev/null 2>&1; }
for chip in gfx1100 gfx1150 gfx1201; do takes $chip && echo "LLVM's assembler takes s_add_f32 for $chip" || true; done
! takes gfx1100 && takes gfx1150 && takes gfx1201 || is_same=false
for value in "a * b + c - max(a - d, floor(b))" "a * b < c * d ? a - c : b + d" "float(uint(a) * 7u + uint(b + c))"; do
    printf '#version 450\n#extension GL_EXT_buffer_reference : require\n%s\nvoid main() { result.value = %s; }\n' \
        'layout(buffer_reference) buffer Result { float value; };
        layout(push_constant) uniform Given { float a, b, c, d; Result result; };' "$value" >"$tmp/shader.comp"
    "$usr/bin/glslangValidator" -V --target-env vulkan1.3 "$tmp/shader.comp" -o "$tmp/shader.spv" >/dev/null
    echo "$value"
    for chip in navi31 gfx1150 gfx1151 gfx1152 gfx1153 gfx1201; do
        RADV_FORCE_FAMILY=$chip "$tmp/compile" <"$tmp/shader.spv" >"$tmp/out" 2>&1 || { cat "$tmp/out"; exit 2; }
        code=$(sed -nE 's/^(Code size|Hash) = //p' "$tmp/out" | paste -sd " ")
        floats=$(sed -n '/^ACO IR$/,/^Assembly$/p' "$tmp/out" | grep -cE '= s_[a-z0-9_]*f32' || true)
        echo "  $(grep ^Null "$tmp/out"): bytes and CRC32 $code, scalar float instructions: $floats"
        [ $chip != navi31 ] || rdna3=$code
        if [ $chip = gfx1201 ]; then [ "$floats" -gt 3 ]; else [ "$code" = "$rdna3" ] && [ "$floats" = 0 ]; fi || is_same=false
    done
done
$is_same && echo "as described" || { echo "BEHAVIOUR CHANGED"; exit 1; }
