#include "core/gpu/device.h"

#include "core/error.h"
#include "core/gpu/device_impl.h"
#include "core/list_text.h"
#include "core/memory_fault.h"
#include "core/near_miss.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

const char* const validation_layer = "VK_LAYER_KHRONOS_validation";
const char* const no_device =
    "there is no Vulkan 1.3 device: install a driver (on Debian: apt-get install mesa-vulkan-drivers)";
const char* const no_hardware =
    "compiles shaders for a chip and runs none: to render, take RADV_FORCE_FAMILY out of the environment";

/// About what lavapipe and its LLVM take before they draw anything (bytes). Loaders and drivers without memory say that
/// there is no driver, or that it cannot be initialised.
constexpr size_t memory_of_driver = 256 << 20;

[[noreturn]] void fail_without_device() {
    if (can_get_memory(memory_of_driver)) fail_machine(no_device);
    fail_machine(memory_sentence(" to load a Vulkan driver"));
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& log = *static_cast<ValidationLog*>(user);
    const std::lock_guard lock(log.mutex);
    log.messages.emplace_back(data->pMessage);
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

bool has_layer(const vk::raii::Context& context, const char* name) {
    return std::ranges::any_of(context.enumerateInstanceLayerProperties(),
                               [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validate) {
    const vk::ApplicationInfo application{.pApplicationName = "ssrlab", .apiVersion = VK_API_VERSION_1_3};
    const vk::ValidationFeatureEnableEXT enabled[] = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = 1, .pEnabledValidationFeatures = enabled};
    const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    if (validate && !has_layer(context, validation_layer))
        fail_machine(
            "the Vulkan validation layer is asked for but not installed (on Debian: apt-get install "
            "vulkan-validationlayers)");
    try {
        return {context, vk::InstanceCreateInfo{.pNext = validate ? &features : nullptr,
                                                .pApplicationInfo = &application,
                                                .enabledLayerCount = validate ? 1u : 0u,
                                                .ppEnabledLayerNames = &validation_layer,
                                                .enabledExtensionCount = validate ? 1u : 0u,
                                                .ppEnabledExtensionNames = extensions}};
    } catch (const vk::IncompatibleDriverError&) {  // what the loader says when it finds no driver at all
        fail_without_device();
    }
}

/// Instances that are never destroyed: with the last one the loader unloads drivers and layers, and loading lavapipe
/// and its LLVM again takes time and leaks what they allocate once.
void keep_drivers_loaded(bool validate) {
    struct Kept {
        vk::raii::Context context;
        vk::raii::Instance instance;
        std::vector<vk::raii::PhysicalDevice> devices;
        explicit Kept(bool validate)
            : instance(make_instance(context, validate)), devices(instance.enumeratePhysicalDevices()) {}
    };
    static const Kept* volatile kept[2] = {nullptr, nullptr};  // volatile: else the pointers are optimised away
    if (!kept[validate]) kept[validate] = new Kept(validate);
}

std::string version_text(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

DeviceInfo describe(const vk::raii::PhysicalDevice& gpu) {
    const auto chain = gpu.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const vk::PhysicalDeviceProperties& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    DeviceInfo info{.name = properties.deviceName.data(),
                    .driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data(),
                    .api = version_text(properties.apiVersion),
                    .type = "other"};
    using Type = vk::PhysicalDeviceType;
    for (const auto& [type, name] : {std::pair(Type::eCpu, "cpu"),
                                     {Type::eDiscreteGpu, "discrete"},
                                     {Type::eIntegratedGpu, "integrated"},
                                     {Type::eVirtualGpu, "virtual"}})
        if (properties.deviceType == type) info.type = name;
    const vk::PhysicalDeviceMemoryProperties memory = gpu.getMemoryProperties();
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            info.memory_mib = std::max(info.memory_mib, double(memory.memoryHeaps[i].size) / (1 << 20));
    return info;
}

/// Vulkan 1.3 devices only: dynamic rendering and synchronization2 are taken for granted. An instance without any
/// driver may fail to enumerate, which is the same as having none.
std::vector<vk::raii::PhysicalDevice> usable_devices(const vk::raii::Instance& instance) {
    std::vector<vk::raii::PhysicalDevice> usable;
    try {
        for (auto& gpu : instance.enumeratePhysicalDevices())
            if (gpu.getProperties().apiVersion >= VK_API_VERSION_1_3) usable.push_back(std::move(gpu));
    } catch (const vk::SystemError&) {
    }
    return usable;
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

size_t choose_by_type(const std::vector<DeviceInfo>& devices) {
    for (const char* type : {"discrete", "integrated", "virtual", "cpu", "other"})
        for (size_t i = 0; i < devices.size(); ++i)
            if (devices[i].type == type && devices[i].has_hardware()) return i;
    fail_machine("'", devices.front().name, "' ", no_hardware, "; there is no other Vulkan device");
}

size_t choose_by_name(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    if (is_device_index(choice))
        if (const size_t index = std::stoul(choice); index < devices.size()) return index;
    std::vector<std::string> names;
    for (size_t i = 0; i < devices.size(); ++i) {
        if (devices[i].fits(choice)) return i;
        names.push_back(std::to_string(i) + " '" + devices[i].name + "'");
    }
    fail("no Vulkan device fits '", choice, "'", suggestion(choice, names));
}

size_t choose(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    if (devices.empty()) fail_without_device();
    if (choice.empty()) return choose_by_type(devices);
    const size_t chosen = choose_by_name(devices, choice);
    if (!devices[chosen].has_hardware()) fail("'", devices[chosen].name, "' ", no_hardware, ", or name another device");
    return chosen;
}

/// Runs `action` and reports what Vulkan throws as a fault of the machine.
template <class Action>
auto translated(const Action& action) {
    try {
        return action();
    } catch (const vk::SystemError& e) {
        if (e.code() == vk::Result::eErrorOutOfHostMemory || e.code() == vk::Result::eErrorOutOfDeviceMemory ||
            !can_get_memory(memory_of_driver))
            fail_machine(memory_sentence(message_text(" for the Vulkan driver (", e.what(), ")")));
        fail_machine("Vulkan: ", e.what());
    }
}

}  // namespace

std::vector<std::string> missing_features(const vk::PhysicalDeviceFeatures& v10,
                                          const vk::PhysicalDeviceVulkan13Features& v13,
                                          const std::vector<vk::ExtensionProperties>& extensions) {
    const bool has_push_descriptors = std::ranges::any_of(extensions, [](const vk::ExtensionProperties& e) {
        return std::strcmp(e.extensionName, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME) == 0;
    });
    struct Needed {
        bool is_there;
        const char *name, *why;
    };
    std::vector<std::string> missing;
    for (const Needed& needed : std::initializer_list<Needed>{
             {bool(v13.robustImageAccess), "robustImageAccess", "reads beyond an image must give zeros"},
             {bool(v10.robustBufferAccess), "robustBufferAccess", "reads beyond a buffer must stay in it"},
             {bool(v13.synchronization2), "synchronization2", "passes wait for each other by it"},
             {bool(v13.dynamicRendering), "dynamicRendering", "passes draw by it"},
             {bool(v13.maintenance4), "maintenance4", "shaders have the sizes of their work groups by it"},
             {bool(v10.independentBlend), "independentBlend", "targets of one pass are blended differently"},
             {bool(v10.fragmentStoresAndAtomics), "fragmentStoresAndAtomics", "fragment shaders write images"},
             {bool(v10.shaderStorageImageExtendedFormats), "shaderStorageImageExtendedFormats",
              "shaders write images of one and two channels"},
             {bool(v10.shaderStorageImageWriteWithoutFormat), "shaderStorageImageWriteWithoutFormat",
              "shaders write images of any format"},
             {has_push_descriptors, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME, "passes name their images by it"}})
        if (!needed.is_there) missing.push_back(std::string(needed.name) + ": " + needed.why);
    return missing;
}

NeededFeatures needed_features() {
    return {
        .v13 = {.robustImageAccess = true, .synchronization2 = true, .dynamicRendering = true, .maintenance4 = true},
        .v12 = {},
        .v10 = {.robustBufferAccess = true,
                .independentBlend = true,
                .fragmentStoresAndAtomics = true,
                .shaderStorageImageExtendedFormats = true,
                .shaderStorageImageWriteWithoutFormat = true}};
}

bool validation_requested() {
    const char* value = std::getenv("SSRLAB_VALIDATE");
    return value && std::string(value) == "1";
}

bool DeviceInfo::fits(const std::string& part_of_name) const {
    return lower(name).find(lower(part_of_name)) != std::string::npos;
}

bool is_device_index(const std::string& choice) {
    const bool has_digits_alone = std::ranges::all_of(choice, [](unsigned char c) { return std::isdigit(c); });
    return has_digits_alone && !choice.empty() && choice.size() < 6;
}

std::vector<DeviceInfo> list_devices() {
    return translated([] {
        keep_drivers_loaded(false);
        const vk::raii::Context context;
        const vk::raii::Instance instance = make_instance(context, false);
        std::vector<DeviceInfo> devices;
        for (const auto& gpu : usable_devices(instance)) devices.push_back(describe(gpu));
        if (devices.empty()) fail_without_device();
        return devices;
    });
}

Device::Device(const std::string& choice, bool validate) : impl_(translated([] { return std::make_unique<Impl>(); })) {
    translated([&] {
        Impl& d = *impl_;
        keep_drivers_loaded(validate);
        d.instance = make_instance(d.context, validate);
        if (validate) {
            using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
            using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
            vk::DebugUtilsMessengerCreateInfoEXT info{.messageSeverity = Severity::eWarning | Severity::eError,
                                                      .messageType = Type::eValidation};
            info.pfnUserCallback = on_message;
            info.pUserData = &d.log;
            d.messenger = {d.instance, info};
        }
        std::vector<vk::raii::PhysicalDevice> gpus = usable_devices(d.instance);
        std::vector<DeviceInfo> infos;
        for (const auto& gpu : gpus) infos.push_back(describe(gpu));
        const size_t index = choose(infos, choice);
        d.gpu = std::move(gpus[index]);
        d.info = infos[index];
        d.nanoseconds_per_tick = d.gpu.getProperties().limits.timestampPeriod;
        d.largest_side = d.gpu.getProperties().limits.maxImageDimension2D;

        const auto families = d.gpu.getQueueFamilyProperties();
        const auto does_all = [](const vk::QueueFamilyProperties& f) {
            return (f.queueFlags & vk::QueueFlagBits::eGraphics) && (f.queueFlags & vk::QueueFlagBits::eCompute);
        };
        const auto family = std::ranges::find_if(families, does_all);
        if (family == families.end())
            fail_machine("the Vulkan device '", d.info.name, "' has no queue for graphics and compute");
        d.queue_family = uint32_t(family - families.begin());
        d.timestamp_bits = family->timestampValidBits;

        const auto has = d.gpu.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                            vk::PhysicalDeviceVulkan13Features>();
        const std::vector<std::string> missing =
            missing_features(has.get<vk::PhysicalDeviceFeatures2>().features,
                             has.get<vk::PhysicalDeviceVulkan13Features>(), d.gpu.enumerateDeviceExtensionProperties());
        if (!missing.empty())
            fail_machine("the Vulkan device '", d.info.name, "' lacks ", joined(missing, "; "),
                         ". Choose another with --device (`ssrlab list devices` names them), or a newer driver");

        const float priority = 1;
        const vk::DeviceQueueCreateInfo queue{
            .queueFamilyIndex = d.queue_family, .queueCount = 1, .pQueuePriorities = &priority};
        const char* const extensions[] = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
        d.has_doubles = has.get<vk::PhysicalDeviceFeatures2>().features.shaderFloat64;
        d.has_half_floats = has.get<vk::PhysicalDeviceVulkan12Features>().shaderFloat16;
        d.has_statistics = has.get<vk::PhysicalDeviceFeatures2>().features.pipelineStatisticsQuery;
        NeededFeatures needed = needed_features();
        needed.v10.pipelineStatisticsQuery = d.has_statistics;
        needed.v10.shaderFloat64 = d.has_doubles;
        needed.v12.shaderFloat16 = d.has_half_floats;
        needed.v13.pNext = &needed.v12;
        d.device = {d.gpu, vk::DeviceCreateInfo{.pNext = &needed.v13,
                                                .queueCreateInfoCount = 1,
                                                .pQueueCreateInfos = &queue,
                                                .enabledExtensionCount = 1,
                                                .ppEnabledExtensionNames = extensions,
                                                .pEnabledFeatures = &needed.v10}};
        d.queue = d.device.getQueue(d.queue_family, 0);
        d.pool = {d.device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                      .queueFamilyIndex = d.queue_family}};
        d.commands =
            std::move(vk::raii::CommandBuffers(
                          d.device, vk::CommandBufferAllocateInfo{.commandPool = *d.pool, .commandBufferCount = 1})
                          .front());
        d.fence = {d.device, vk::FenceCreateInfo{}};
    });
}

Device::~Device() = default;

const DeviceInfo& Device::info() const { return impl_->info; }

std::vector<std::string> Device::validation_messages() const {
    const std::lock_guard lock(impl_->log.mutex);
    return impl_->log.messages;
}

bool Device::has_doubles() const { return impl_->has_doubles; }

bool Device::has_half_floats() const { return impl_->has_half_floats; }

bool Device::supports(Format format) const {
    const auto features = impl_->gpu.getFormatProperties(vulkan_format(format)).optimalTilingFeatures;
    const bool is_depth = bool(aspect_of(format) & vk::ImageAspectFlagBits::eDepth);
    return bool(features & (is_depth ? vk::FormatFeatureFlagBits::eDepthStencilAttachment
                                     : vk::FormatFeatureFlagBits::eSampledImage));
}

vk::raii::DeviceMemory Device::Impl::allocate(const vk::MemoryRequirements& requirements,
                                              vk::MemoryPropertyFlags required, vk::MemoryPropertyFlags preferred) {
    const vk::PhysicalDeviceMemoryProperties memory = gpu.getMemoryProperties();
    for (const vk::MemoryPropertyFlags wanted : {required | preferred, required})
        for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((requirements.memoryTypeBits >> i & 1) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
                try {
                    return {device, vk::MemoryAllocateInfo{.allocationSize = requirements.size, .memoryTypeIndex = i}};
                } catch (const vk::SystemError&) {
                    fail_machine("the Vulkan device '", info.name, "' has no ", requirements.size >> 20,
                                 " MiB of memory left: choose a smaller size");
                }
    fail_machine("the Vulkan device '", info.name, "' has no suitable memory type");
}

void Device::Impl::submit_and_wait(const vk::raii::CommandBuffer& ended, const vk::raii::Fence& done) {
    try {
        const vk::CommandBuffer buffer = *ended;
        queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &buffer}, *done);
        if (device.waitForFences(*done, true, UINT64_MAX) != vk::Result::eSuccess)
            fail_machine("the Vulkan device '", info.name, "' did not finish its work");
        device.resetFences(*done);
    } catch (const vk::SystemError& e) {
        fail_machine("the Vulkan device '", info.name, "' failed: ", e.what());
    }
}

void Device::Impl::submit(const std::function<void(vk::raii::CommandBuffer&)>& record) {
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
    submit_and_wait(commands, fence);
}

DeviceBuffer::DeviceBuffer(Device::Impl& gpu, size_t size, vk::BufferUsageFlags usage, bool is_host_visible)
    : buffer(gpu.device, vk::BufferCreateInfo{.size = size, .usage = usage}) {
    using Property = vk::MemoryPropertyFlagBits;
    memory = is_host_visible ? gpu.allocate(buffer.getMemoryRequirements(),
                                            Property::eHostVisible | Property::eHostCoherent, Property::eHostCached)
                             : gpu.allocate(buffer.getMemoryRequirements(), {}, Property::eDeviceLocal);
    buffer.bindMemory(*memory, 0);
    if (is_host_visible) data = static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
}
