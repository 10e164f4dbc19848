// chip_compiler CHIP RECIPES RESULTS [--assembly] [--driver FILE]: what Mesa's radv makes of pipelines for a chip that
// is not there.
//
// A program of its own: radv reads the chip's name from the environment when it is loaded, once, and ends the process
// on a name that it does not know. RECIPES holds bytes_of(), RESULTS gets a JSON object a line, each as soon as it is
// known: the device, then what became of each recipe, or `error` of all. Lines are missing where the compiler ended the
// process. FILE is a radv that is not installed; `unusable` says why it cannot be used.
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/pipelines/pipeline.h"

#include <dlfcn.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

using nlohmann::json;

namespace {

/// Libraries beside the driver come before those of the system. The linker reads the variable once, when a program
/// starts.
void start_again_beside(const std::string& driver, char** arguments) {
    const char *const variable = "LD_LIBRARY_PATH", *const before = std::getenv(variable);
    const std::string folder = std::filesystem::path(driver).parent_path().string();
    if (before && std::string(before).starts_with(folder)) return;
    setenv(variable, (before ? folder + ":" + before : folder).c_str(), 1);
    execv("/proc/self/exe", arguments);
}

struct Unusable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The first function of a driver, which the loader of Vulkan asks for all others.
PFN_vkGetInstanceProcAddr functions_of(const std::string& driver) {
    void* const library = dlopen(driver.c_str(), RTLD_NOW);
    if (!library) throw Unusable(dlerror());
    void* const function = dlsym(library, "vk_icdGetInstanceProcAddr");
    if (!function) throw Unusable(driver + " is no driver of Vulkan");
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(function);
}

/// The device without hardware among those that there are; nothing where radv is not installed.
std::optional<vk::raii::PhysicalDevice> find_chip(const vk::raii::Instance& instance) {
    for (vk::raii::PhysicalDevice& device : instance.enumeratePhysicalDevices())
        if (std::string(device.getProperties().deviceName.data()).starts_with(no_hardware_prefix))
            return std::move(device);
    return {};
}

json describe(const vk::raii::PhysicalDevice& chip) {
    const auto chain = chip.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return {{"device", chain.get<vk::PhysicalDeviceProperties2>().properties.deviceName.data()},
            {"driver", std::string(driver.driverName.data()) + " " + driver.driverInfo.data()}};
}

/// With what our pipelines need of a device (Device), and nothing else: no queue of it can be used.
vk::raii::Device make_device(const vk::raii::PhysicalDevice& chip) {
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = 0, .queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR executables{.pipelineExecutableInfo = true};
    NeededFeatures needed = needed_features();
    const auto has = chip.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    needed.v12.shaderFloat16 = has.get<vk::PhysicalDeviceVulkan12Features>().shaderFloat16;  // before GFX9 none has it
    needed.v13.pNext = &needed.v12;
    needed.v12.pNext = &executables;
    needed.v10.shaderFloat64 = true;
    const char* const extensions[] = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME,
                                      VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME};
    return {chip, vk::DeviceCreateInfo{.pNext = &needed.v13,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .enabledExtensionCount = 2,
                                       .ppEnabledExtensionNames = extensions,
                                       .pEnabledFeatures = &needed.v10}};
}

json value_of(const vk::PipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
        case vk::PipelineExecutableStatisticFormatKHR::eBool32:
            return bool(statistic.value.b32);
        case vk::PipelineExecutableStatisticFormatKHR::eInt64:
            return statistic.value.i64;
        case vk::PipelineExecutableStatisticFormatKHR::eUint64:
            return statistic.value.u64;
        case vk::PipelineExecutableStatisticFormatKHR::eFloat64:
            return statistic.value.f64;
    }
    return nullptr;
}

/// The driver's texts of a shader by their names, of which "Assembly" is one.
json texts_of(const vk::raii::Device& device, const vk::PipelineExecutableInfoKHR& shader) {
    json texts = json::object();
    const auto get = reinterpret_cast<PFN_vkGetPipelineExecutableInternalRepresentationsKHR>(
        device.getProcAddr("vkGetPipelineExecutableInternalRepresentationsKHR"));
    const VkPipelineExecutableInfoKHR& info = shader;
    uint32_t count = 0;
    get(*device, &info, &count, nullptr);
    std::vector<VkPipelineExecutableInternalRepresentationKHR> list(
        count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR, nullptr, {}, {}, 0, 0, nullptr});
    get(*device, &info, &count, list.data());
    std::vector<std::string> buffers;
    for (auto& text : list) buffers.emplace_back(text.dataSize, '\0');
    for (size_t i = 0; i < list.size(); ++i) list[i].pData = buffers[i].data();
    get(*device, &info, &count, list.data());
    for (size_t i = 0; i < list.size(); ++i)
        if (list[i].isText) texts[list[i].name] = std::string(buffers[i].c_str());
    return texts;
}

json compile(const vk::raii::Device& device, const PipelineRecipe& recipe, bool has_assembly) {
    vk::PipelineCreateFlags flags = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR;
    if (has_assembly) flags |= vk::PipelineCreateFlagBits::eCaptureInternalRepresentationsKHR;
    const Pipeline made = make_pipeline(device, recipe, flags);
    json shaders = json::array();
    const auto executables = device.getPipelineExecutablePropertiesKHR({.pipeline = *made.pipeline});
    for (uint32_t i = 0; i < executables.size(); ++i) {
        const vk::PipelineExecutableInfoKHR which{.pipeline = *made.pipeline, .executableIndex = i};
        json statistics = json::object();
        for (const auto& statistic : device.getPipelineExecutableStatisticsKHR(which))
            statistics[statistic.name.data()] = value_of(statistic);
        shaders.push_back({{"stages", uint32_t(executables[i].stages)},
                           {"lanes", executables[i].subgroupSize},
                           {"statistics", statistics},
                           {"texts", has_assembly ? texts_of(device, which) : json::object()}});
    }
    return {{"shaders", shaders}};
}

struct Order {
    std::string chip, recipes, driver;  ///< driver: a file; "": those that are installed
    bool has_assembly = false;
};

void compile_all(const Order& order, std::ostream& results) {
    setenv("RADV_FORCE_FAMILY", order.chip.c_str(), 1);
    for (const char* changes_code : {"RADV_PERFTEST", "RADV_DEBUG", "ACO_DEBUG"}) unsetenv(changes_code);
    if (!std::freopen("/dev/null", "w", stderr)) std::cerr << '\n';  // where radv names what it does not know
    const auto put = [&](const json& line) { results << line.dump() << std::endl; };
    const vk::raii::Context context;
    // Debian 12's vk::raii::Context has no constructor for other functions than the loader's.
    if (!order.driver.empty())
        const_cast<vk::raii::ContextDispatcher&>(*context.getDispatcher()) =
            vk::raii::ContextDispatcher(functions_of(order.driver));
    const vk::ApplicationInfo application{.pApplicationName = "ssrlab", .apiVersion = VK_API_VERSION_1_3};
    const vk::raii::Instance instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &application});
    const std::optional<vk::raii::PhysicalDevice> chip = find_chip(instance);
    if (!chip && !order.driver.empty()) throw Unusable(order.driver + " has no device that compiles without a GPU");
    if (!chip) return put({{"refusal", "there is no radv"}});
    put(describe(*chip));
    const vk::raii::Device device = make_device(*chip);
    for (const PipelineRecipe& recipe : recipes_of(order.recipes)) try {
            put(compile(device, recipe, order.has_assembly));
        } catch (const vk::SystemError& e) {
            put({{"refusal", e.what()}});
        }
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 4) {
        std::cerr << "usage: chip_compiler CHIP RECIPES RESULTS [--assembly] [--driver FILE], as ssrlab starts it\n";
        return 2;
    }
    Order order{.chip = arguments[1], .recipes = {}, .driver = {}};
    for (int i = 4; i < count; ++i)
        if (arguments[i] == std::string("--driver") && i + 1 < count)
            order.driver = arguments[++i];
        else
            order.has_assembly = true;
    if (!order.driver.empty()) start_again_beside(order.driver, arguments);
    std::ofstream results(arguments[3]);
    const auto say = [&](const char* what, const std::exception& why) {
        results << json{{what, why.what()}}.dump() << std::endl;
    };
    try {
        order.recipes = read_text(arguments[2]);
        compile_all(order, results);
    } catch (const Unusable& e) {
        say("unusable", e);
    } catch (const std::exception& e) {
        say("error", e);
    }
    return results ? 0 : 3;
}
