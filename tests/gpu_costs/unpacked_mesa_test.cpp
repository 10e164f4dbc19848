// Chips of a Mesa that is unpacked and not installed.
#include "experiments/gpu_costs/chips/unpacked_mesa.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_list.h"
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "experiments/gpu_costs/chips/occupancy.h"
#include "tests/error_message.h"
#include "tests/gpu_costs/fake_mesa.h"

#include <gtest/gtest.h>
#include <cstdlib>

namespace fs = std::filesystem;

namespace {

struct UnpackedMesa : testing::Test {
    fs::path folder = fs::temp_directory_path() / "unpacked_mesa_test";
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// What find_chip() says of a mistake; a fault of the machine is none.
    std::string mistake(const std::string& chip, const fs::path& mesa) {
        try {
            find_chip(chip, mesa);
        } catch (const MachineError& e) {
            ADD_FAILURE() << e.what();
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }
    void expect_in(const std::string& message, std::initializer_list<const char*> parts) {
        for (const char* part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks " << part;
    }
};

}  // namespace

TEST_F(UnpackedMesa, IsFoundWherePackagesHaveIt) {
    EXPECT_EQ(radv_in(""), fs::path());
    for (const char* place : {"usr/lib", "usr/lib/x86_64-linux-gnu", "usr/lib64/../lib/other"}) {
        fs::remove_all(folder / "usr");
        const fs::path file = (folder / place).lexically_normal() / "libvulkan_radeon.so";
        write_text(file, "");
        EXPECT_EQ(radv_in(folder), file);
    }
}

TEST_F(UnpackedMesa, NamesAWayOutOfFoldersWithoutADriver) {
    const auto message = [&](const fs::path& mesa) { return mistake("navi21", mesa); };
    expect_in(message(folder / "nowhere"), {"nowhere", "does not exist", "newer_mesa.sh"});
    expect_in(message(folder), {"has no libvulkan_radeon.so", "newer_mesa.sh"});
    write_text(folder / "usr/lib/x86_64-linux-gnu/libvulkan_intel.so", "");
    expect_in(message(folder), {"has no libvulkan_radeon.so", "newer_mesa.sh"});
    expect_in(message(folder / "usr/lib/x86_64-linux-gnu/libvulkan_intel.so"), {"is no folder", "newer_mesa.sh"});
}

TEST_F(UnpackedMesa, SaysWhyADriverCannotBeUsed) {
    write_text(folder / "usr/lib/libvulkan_radeon.so", "no library");
    expect_in(mistake("navi21", folder), {"cannot be used", "libvulkan_radeon.so", "dpkg -x"});
}

TEST_F(UnpackedMesa, CompilesInsteadOfTheInstalledOne) {
    if (!unpack_fake_mesa(folder)) GTEST_SKIP() << "no radv is installed";
    EXPECT_EQ(find_chip("navi21", folder).driver.substr(0, 12), "radv Mesa 99");
    EXPECT_NE(find_chip("navi21", "").driver.substr(0, 12), "radv Mesa 99");
    expect_in(mistake("navi2", folder), {"radv Mesa 99", "knows no chip 'navi2'; did you mean 'navi", "Mesa 22.3.6",
                                         "25.0.7 also for", "gfx1201"});
}

TEST_F(UnpackedMesa, KnowsBothNamesOfAChip) {
    EXPECT_EQ(other_name("gfx1100"), "navi31");
    EXPECT_EQ(other_name("navi31"), "gfx1100");
    EXPECT_EQ(other_name("navi21"), "");
    EXPECT_EQ(chip_rates("navi31")->product, chip_rates("gfx1100")->product);
    try {
        for (const char* name : {"gfx1100", "navi31"}) {
            const Chip chip = find_chip(name, "");
            EXPECT_EQ(chip.name, name);
            EXPECT_TRUE(chip.name_in_driver == "gfx1100" || chip.name_in_driver == "navi31") << chip.name_in_driver;
        }
    } catch (const MachineError& e) {
        GTEST_SKIP() << e.what();
    }
}

TEST_F(UnpackedMesa, IsRecommendedForNewerChips) {
    if (!unpack_fake_mesa(folder)) GTEST_SKIP() << "no radv is installed";
    const std::string message = error_message([&] { find_chip("gfx1201", folder); });
    if (message.empty()) GTEST_SKIP() << "the installed radv knows gfx1201";
    expect_in(message, {"does not know the chip 'gfx1201'", "Mesa 25.0.7", "newer_mesa.sh FOLDER", "SSRLAB_MESA"});
}

/// The device without hardware of Mesa 25.0.7 states waves as if 512 registers were there, where RDNA 4 has 768.
TEST(OccupancyOfRdna4, IsThatOfItsRegisters) {
    const auto occupancy = [](double vgprs, double stated, double lds_bytes) {
        CompiledShader shader;
        shader.lanes = 64, shader.vgprs = vgprs, shader.sgprs = 128, shader.waves = stated;
        shader.lds_bytes = lds_bytes;
        return occupancy_of("gfx1201", shader);
    };
    EXPECT_EQ(occupancy(48, 20, 0).waves, 16u);
    EXPECT_EQ(occupancy(108, 8, 0).waves, 7u);
    EXPECT_EQ(occupancy(108, 8, 0).limit, "registers");
    EXPECT_EQ(occupancy(108, 14, 0).waves, 7u) << "as a corrected Mesa states it";
    EXPECT_EQ(occupancy(48, 4, 16384).waves, 2u);
    EXPECT_EQ(occupancy(48, 4, 16384).limit, "shared memory");
}

/// A newer Mesa may name its statistics otherwise: all that ssrlab knows must be there.
TEST_F(UnpackedMesa, CompilesForChipsOfToday) {
    if (chosen_mesa().empty())
        GTEST_SKIP() << "SSRLAB_MESA is not set: `experiments/newer_mesa.sh FOLDER` unpacks a newer Mesa for it";
    Device device;
    ParameterSet no_parameters;
    CameraData camera{};
    PassList pass_list(device, {16, 16});
    struct Watcher : PassWatcher {
        std::vector<PipelineRecipe> recipes;
        std::optional<InstrumentedPipeline> before(const PassRun& run) override {
            recipes.push_back(run.recipe);
            return {};
        }
    } watcher;
    pass_list.watch(&watcher);
    pass_list.begin_frame(camera, no_parameters, {});
    pass_list.compute("shared_memory.comp").write(pass_list.image("target", Format::rgba32f)).run();
    for (const char* name : {"navi21", "gfx1100", "gfx1150", "gfx1151", "gfx1152", "gfx1153", "gfx1200", "gfx1201"}) {
        const std::vector<CompiledPipeline> compiled =
            compile_for_chip(find_chip(name), watcher.recipes, {.cache = {}, .notice = {}});
        ASSERT_EQ(compiled.size(), 1u);
        ASSERT_EQ(compiled[0].shaders.size(), 1u) << name << ": " << compiled[0].refusal;
        const CompiledShader& shader = compiled[0].shaders[0];
        for (const CompilerNumber& number : compiler_numbers)
            EXPECT_TRUE((shader.*number.member).has_value()) << name << " has no " << number.name;
        EXPECT_EQ(shader.lds_bytes, 16384) << name;
        EXPECT_EQ(occupancy_of(name, shader).limit, "shared memory") << name;
    }
}
