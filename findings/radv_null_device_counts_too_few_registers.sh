#!/usr/bin/env bash
# RADV, Mesa's Vulkan driver of AMD GPUs, says how many subgroups of a shader a SIMD holds, and compiles for a chip that is not
# there if RADV_FORCE_FAMILY names the chip. For gfx1151 (RDNA 3.5), gfx1200 and gfx1201 (RDNA 4) RADV then counts 1024 vector
# registers a SIMD (in subgroups of 32). LLVM counts 1536, as both do for navi31 (gfx1100). Of a shader with 96 registers the
# SIMD holds 10 subgroups by RADV, and 16 by LLVM. For gfx1151 code and registers are navi31's, and only the count is less.
# RADV hands out registers in steps of 24 for these chips (72), as for 1536 registers, and then counts in steps of 16.
# The reason is in Mesa's radv_null_winsys.c, which names only navi31 and navi32 as chips with the larger register file.
# For whom: who compares occupancy of chips without the chips: count it yourself, 1536 / registers and at most 16. A chip that
# is there tells the driver its number, which this script does not run. LLVM's test occupancy-levels.ll has LLVM's numbers too.
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

cat >"$tmp/occupancy.c" <<'C'
#include <stdio.h>
#include <vulkan/vulkan.h>
#define MUST(call) if ((call) != VK_SUCCESS) return puts("failed: " #call), 2
int main(void) {  // of the compute shader on the standard input, which has one buffer: the driver's statistics
    static uint32_t words[1 << 16];
    VkInstance instance; VkPhysicalDevice chip; VkDevice device; VkDescriptorSetLayout set; uint32_t count = 1;
    const size_t size = fread(words, 1, sizeof words, stdin);
    const VkShaderModuleCreateInfo shader = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0, size, words};
    const VkApplicationInfo app = {VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
    MUST(vkCreateInstance(&(VkInstanceCreateInfo){VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, NULL, 0, &app}, NULL, &instance));
    MUST(vkEnumeratePhysicalDevices(instance, &count, &chip));
    const VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR, .pipelineExecutableInfo = VK_TRUE};
    const char* name = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    const VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, NULL, 0, 0, 1, &(float){1}};
    const VkDeviceCreateInfo open = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &statistics, 0, 1, &queue, 0, NULL, 1, &name, NULL};
    MUST(vkCreateDevice(chip, &open, NULL, &device));
    const VkDescriptorSetLayoutBinding buffer = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    const VkDescriptorSetLayoutCreateInfo buffers = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, NULL, 0, 1, &buffer};
    MUST(vkCreateDescriptorSetLayout(device, &buffers, NULL, &set));
    const VkPipelineLayoutCreateInfo sets = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, NULL, 0, 1, &set, 0, NULL};
    VkComputePipelineCreateInfo pipeline = {VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, NULL,
        VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR, {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = VK_SHADER_STAGE_COMPUTE_BIT, .pName = "main"}};
    MUST(vkCreatePipelineLayout(device, &sets, NULL, &pipeline.layout));
    MUST(vkCreateShaderModule(device, &shader, NULL, &pipeline.stage.module));
    VkPipelineExecutableInfoKHR compiled = {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR};
    MUST(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline, NULL, &compiled.pipeline));
    VkPipelineExecutableStatisticKHR found[64] = {0};
    for (count = 0; count < 64; ++count) found[count].sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    PFN_vkGetPipelineExecutableStatisticsKHR get =
        (PFN_vkGetPipelineExecutableStatisticsKHR)vkGetDeviceProcAddr(device, "vkGetPipelineExecutableStatisticsKHR");
    MUST(get(device, &compiled, &count, found));
    for (uint32_t i = 0; i < count; ++i) printf("%s = %u\n", found[i].name, (uint32_t)found[i].value.u64);
}
C
gcc -I"$usr/include" "$tmp/occupancy.c" -o "$tmp/occupancy" "$usr/lib/x86_64-linux-gnu/libvulkan.so.1"
export LD_LIBRARY_PATH="$usr/lib/x86_64-linux-gnu:$tmp/root/lib/x86_64-linux-gnu"
export VK_ICD_FILENAMES="$usr/share/vulkan/icd.d/radeon_icd.json" MESA_SHADER_CACHE_DISABLE=1
found=
for side in 6 8; do  # a tile of side x side sums is held in registers
    cat >"$tmp/tile.comp" <<GLSL
#version 450
layout(local_size_x = 32) in;
layout(binding = 0) buffer Numbers { float numbers[]; };
void main() {
    float tile[$side][$side], left[$side], right[$side];
    for (int i = 0; i < $side * $side; ++i) tile[i / $side][i % $side] = 0.0;
    for (uint at = gl_GlobalInvocationID.x; at < 131072u; at += 2048u) {
        for (int i = 0; i < $side; ++i) left[i] = numbers[at + 64u * i], right[i] = numbers[at + 64u * ($side + i)];
        for (int i = 0; i < $side * $side; ++i) tile[i / $side][i % $side] += left[i / $side] * right[i % $side];
    }
    for (int i = 0; i < $side * $side; ++i) numbers[gl_GlobalInvocationID.x + 64u * i] = tile[i / $side][i % $side];
}
GLSL
    "$usr/bin/glslangValidator" -V --target-env vulkan1.3 "$tmp/tile.comp" -o "$tmp/tile.spv" >/dev/null
    for chips in navi31=gfx1100 navi33=gfx1102 gfx1150=gfx1150 gfx1151=gfx1151 gfx1200=gfx1200 gfx1201=gfx1201; do
        chip=${chips%=*}  # by RADV's name, and by LLVM's
        RADV_FORCE_FAMILY=$chip "$tmp/occupancy" <"$tmp/tile.spv" >"$tmp/out" 2>&1 || { cat "$tmp/out"; exit 2; }
        IFS=, read -r registers radv crc < <(sed -nE 's/^(VGPRs|Subgroups per SIMD|Hash) = //p' "$tmp/out" | paste -sd ,)
        llvm=$(echo "define amdgpu_kernel void @k() { call void asm sideeffect \"\", \"~{v$((registers - 1))}\"() ret void }" |
            "$usr/lib/llvm-19/bin/llc" -mtriple=amdgcn -mcpu="${chips#*=}" | sed -n 's/^; Occupancy: //p')
        echo "$chip: code $crc, registers: $registers, subgroups a SIMD: $radv by RADV, $llvm by LLVM"
        found+=" $chip:$registers:$radv/$llvm"
        if [ $chip = navi31 ]; then code=$crc; elif [ $chip = gfx1151 ] && [ "$crc" != "$code" ]; then found+=" other code"; fi
    done
done
expected=" navi31:72:16/16 navi33:64:16/16 gfx1150:64:16/16 gfx1151:72:12/16 gfx1200:72:12/16 gfx1201:72:12/16"
expected+=" navi31:96:16/16 navi33:96:10/10 gfx1150:96:10/10 gfx1151:96:10/16 gfx1200:96:10/16 gfx1201:96:10/16"
[ "$found" = "$expected" ] && echo "as described" || { echo "BEHAVIOUR CHANGED"; exit 1; }
