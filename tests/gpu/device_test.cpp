#include "core/gpu/device.h"
#include "core/error.h"
#include "core/gpu/device_impl.h"
#include "core/gpu/passes/pass_list.h"

#include <gtest/gtest.h>
#include <cstdlib>
#include <filesystem>

namespace {

bool contains(const std::vector<std::string>& messages, const std::string& part) {
    return std::ranges::any_of(messages, [&](const std::string& m) { return m.find(part) != std::string::npos; });
}

/// Exits with 0 if `action` throws a MachineError that names what to install.
template <class Action>
void exit_with_verdict(const Action& action) {
    try {
        action();
    } catch (const MachineError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        std::exit(std::string(error.what()).find("mesa-vulkan-drivers") != std::string::npos ? 0 : 1);
    }
    std::exit(2);
}

}  // namespace

// In a process of its own, since the loader reads these once.
TEST(NoDeviceDeathTest, IsAFaultOfTheMachine) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto without_drivers = [](const auto& action) {
        for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) setenv(name, "/nonexistent/driver.json", 1);
        exit_with_verdict(action);
    };
    EXPECT_EXIT(without_drivers([] { Device("", false); }), testing::ExitedWithCode(0),
                "there is no Vulkan 1.3 device");
    EXPECT_EXIT(without_drivers([] { list_devices(); }), testing::ExitedWithCode(0), "there is no Vulkan 1.3 device");
}

/// radv, which mesa-vulkan-drivers has, compiles for a chip that is not there, and crashes where it is asked to render.
TEST(NullHardwareDeathTest, IsRefused) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    std::filesystem::path radv;
    for (const auto& entry : std::filesystem::directory_iterator("/usr/share/vulkan/icd.d"))
        if (entry.path().filename().string().starts_with("radeon_icd")) radv = entry.path();
    if (radv.empty()) GTEST_SKIP() << "no radv in /usr/share/vulkan/icd.d";
    const auto exit_saying = [&](const std::string& choice, bool is_alone) {
        setenv("RADV_FORCE_FAMILY", "navi21", 1);
        for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"})
            if (is_alone) setenv(name, radv.c_str(), 1);
        try {
            const Device device(choice, false);
            std::fprintf(stderr, "hardware: %d\n", device.info().has_hardware());
        } catch (const Error& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
        std::exit(0);
    };
    EXPECT_EXIT(exit_saying("", false), testing::ExitedWithCode(0), "hardware: 1");
    EXPECT_EXIT(exit_saying("null", false), testing::ExitedWithCode(0),
                "'Null hardware .* runs none: to render, take RADV_FORCE_FAMILY");
    EXPECT_EXIT(exit_saying("", true), testing::ExitedWithCode(0), "there is no other Vulkan device");
}

TEST(Device, DescribesItself) {
    const DeviceInfo info = Device().info();
    EXPECT_FALSE(info.name.empty() || info.driver.empty() || info.type.empty());
    EXPECT_TRUE(info.api.starts_with("1."));
    EXPECT_GT(info.memory_mib, 0.0);
}

TEST(Device, NamesEachFeatureThatItLacks) {
    Device device;
    const vk::raii::PhysicalDevice& gpu = device.impl().gpu;
    const auto has = gpu.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>();
    vk::PhysicalDeviceFeatures v10 = has.get<vk::PhysicalDeviceFeatures2>().features;
    vk::PhysicalDeviceVulkan13Features v13 = has.get<vk::PhysicalDeviceVulkan13Features>();
    EXPECT_TRUE(missing_features(v10, v13, gpu.enumerateDeviceExtensionProperties()).empty());
    v10.independentBlend = false, v13.robustImageAccess = false;
    const std::vector<std::string> missing = missing_features(v10, v13, {});
    ASSERT_EQ(missing.size(), 3u);
    for (const char* name : {"independentBlend: ", "robustImageAccess: ", "VK_KHR_push_descriptor: "})
        EXPECT_TRUE(contains(missing, name)) << name;
}

TEST(Device, PicksTheOnlyOneByItself) {
    if (list_devices().size() > 1) GTEST_SKIP() << "several devices";
    EXPECT_EQ(Device().info().name, list_devices().front().name);
}

// Silence of the validation layer in all other tests is meaningful only if it reports here.
TEST(Validation, ReportsAMissingBarrier) {
    Device device("", true);
    Device::Impl& gpu = device.impl();
    const DeviceBuffer buffer(gpu, 1024, vk::BufferUsageFlagBits::eTransferDst, false);
    gpu.submit([&](auto& commands) {
        commands.fillBuffer(*buffer.buffer, 0, VK_WHOLE_SIZE, 1);
        commands.fillBuffer(*buffer.buffer, 0, VK_WHOLE_SIZE, 2);
    });
    EXPECT_TRUE(contains(device.validation_messages(), "SYNC-HAZARD-WRITE-AFTER-WRITE"));
}

TEST(Validation, IsOffUnlessAskedFor) {
    Device device("", false);
    Device::Impl& gpu = device.impl();
    const DeviceBuffer buffer(gpu, 1024, vk::BufferUsageFlagBits::eTransferDst, false);
    gpu.submit([&](auto& commands) {
        commands.fillBuffer(*buffer.buffer, 0, VK_WHOLE_SIZE, 1);
        commands.fillBuffer(*buffer.buffer, 0, VK_WHOLE_SIZE, 2);
    });
    EXPECT_TRUE(device.validation_messages().empty());
}
