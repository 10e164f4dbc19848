#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/chips/occupancy.h"
#include "tests/error_message.h"
#include "tests/gpu_costs/known_chip.h"

#include <gtest/gtest.h>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace {

/// Recipes of passes that run on the default device, and a cache of its own.
struct ChipCompiler : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    ParameterSet no_parameters;
    CameraData camera{};
    PassList pass_list{device(), {16, 16}};
    std::vector<PipelineRecipe> recipes;
    struct Watcher : PassWatcher {
        std::vector<PipelineRecipe>& recipes;
        explicit Watcher(std::vector<PipelineRecipe>& r) : recipes(r) {}
        std::optional<InstrumentedPipeline> before(const PassRun& run) override {
            recipes.push_back(run.recipe);
            return {};
        }
    } watcher{recipes};
    fs::path cache = fs::temp_directory_path() / "chip_cache";
    std::vector<std::string> notices;

    void SetUp() override {
        try {
            known_chip("navi21");
        } catch (const MachineError& e) {
            GTEST_SKIP() << e.what();
        }
        fs::remove_all(cache);
        pass_list.watch(&watcher);
        pass_list.begin_frame(camera, no_parameters, {});
    }
    void store(const std::string& shader) {
        pass_list.compute(shader).write(pass_list.image("target", Format::rgba32f)).run();
    }
    std::vector<CompiledPipeline> compile(const std::string& chip, const fs::path& folder = {}) {
        return compile_for_chip(known_chip(chip), recipes,
                                {.cache = folder, .notice = [this](const std::string& n) { notices.push_back(n); }});
    }
};

/// The value of an environment variable while it lives.
struct Environment {
    const char* name;
    Environment(const char* name, const std::string& value) : name(name) { setenv(name, value.c_str(), 1); }
    ~Environment() { unsetenv(name); }
};

}  // namespace

/// Chips before GFX9 have no half floats in shaders: what a device may have is not asked of them.
TEST_F(ChipCompiler, CompilesForEachGeneration) {
    store("shared_memory.comp");
    for (const char* chip : {"pitcairn", "polaris10", "vega10", "navi21", "gfx1100"}) {
        const std::vector<CompiledPipeline> compiled = compile(chip);
        ASSERT_EQ(compiled.size(), 1u);
        EXPECT_EQ(compiled[0].refusal, "") << chip;
    }
}

/// 16 KiB in each workgroup of one wave: a compute unit of vega10 has 64 KiB for four SIMDs, a pair of units of RDNA
/// 128 KiB for four (AMD, RDNA 2 and Vega instruction set architectures, chapters on the local data share).
TEST_F(ChipCompiler, StatesSharedMemoryAndWhatItLimits) {
    store("shared_memory.comp");
    for (const auto& [chip, waves] : {std::pair("vega10", 1u), std::pair("navi21", 2u), std::pair("gfx1100", 2u)}) {
        const std::vector<CompiledPipeline> compiled = compile(chip);
        ASSERT_EQ(compiled.size(), 1u);
        ASSERT_EQ(compiled[0].shaders.size(), 1u) << compiled[0].refusal;
        const CompiledShader& shader = compiled[0].shaders[0];
        EXPECT_EQ(shader.stage, "compute");
        EXPECT_EQ(shader.lds_bytes, 16384u) << chip;
        EXPECT_EQ(shader.spilled_vgprs, 0u) << chip;
        EXPECT_GT(shader.instructions.value_or(0), 16u) << chip;
        const Occupancy occupancy = occupancy_of(chip, shader);
        EXPECT_EQ(occupancy.waves, waves) << chip;
        EXPECT_EQ(occupancy.limit, "shared memory") << chip;
    }
}

TEST_F(ChipCompiler, KnowsTheSameMachineCode) {
    store("shared_memory.comp"), store("shared_memory.comp"), store("store_value.comp");
    const std::vector<CompiledPipeline> compiled = compile("navi21");
    ASSERT_EQ(compiled.size(), 3u);
    const auto hash = [&](size_t i) { return compiled[i].shaders.at(0).hash; };
    EXPECT_FALSE(hash(0).empty());
    EXPECT_EQ(hash(0), hash(1));
    EXPECT_NE(hash(0), hash(2));
}

TEST_F(ChipCompiler, GoesOnBehindAPipelineThatEndsTheCompiler) {
    store("shared_memory.comp"), store("store_value.comp"), store("shared_memory.comp");
    for (std::vector<unsigned>& module : recipes[1].spirv) module.resize(module.size() / 2);
    const std::vector<CompiledPipeline> compiled = compile("navi21", cache);
    ASSERT_EQ(compiled.size(), 3u);
    EXPECT_FALSE(compiled[1].refusal.empty());
    for (const size_t i : {0, 2}) EXPECT_EQ(compiled[i].shaders.size(), 1u) << compiled[i].refusal;
}

TEST_F(ChipCompiler, KeepsWhatItKnows) {
    store("shared_memory.comp");
    compile("navi21", cache);
    ASSERT_TRUE(fs::exists(cache / "chips"));
    const fs::path kept = fs::directory_iterator(cache / "chips")->path();
    nlohmann::json changed = nlohmann::json::parse(read_text(kept));
    changed["shaders"][0]["statistics"]["VGPRs"] = 77;
    write_text(kept, changed.dump());
    EXPECT_EQ(compile("navi21", cache).at(0).shaders.at(0).vgprs, 77u) << "from the cache";
    EXPECT_NE(compile("vega10", cache).at(0).shaders.at(0).vgprs, 77u) << "of another chip";

    for (const char* broken : {"", "{\"shaders\": [", "[]", "{\"shaders\": [{}]}", "{\"shaders\": 7}"}) {
        write_text(kept, broken);
        const CompiledPipeline again = compile("navi21", cache).at(0);
        ASSERT_EQ(again.shaders.size(), 1u) << broken;
        EXPECT_EQ(again.shaders[0].lds_bytes, 16384u) << "compiled again instead of " << broken;
    }
}

/// A newer Mesa may name its statistics otherwise.
TEST_F(ChipCompiler, LeavesOutWhatIsNotStated) {
    store("shared_memory.comp");
    compile("navi21", cache);
    const fs::path kept = fs::directory_iterator(cache / "chips")->path();
    nlohmann::json changed = nlohmann::json::parse(read_text(kept));
    changed["shaders"][0]["statistics"] = {{"Vector registers", 16}};
    write_text(kept, changed.dump());
    const CompiledShader shader = compile("navi21", cache).at(0).shaders.at(0);
    EXPECT_FALSE(shader.vgprs || shader.waves || shader.instructions);
    EXPECT_EQ(shader.hash, "");
    EXPECT_EQ(occupancy_of("navi21", shader).limit, "");
}

TEST_F(ChipCompiler, SaysThatACacheCannotBeWritten) {
    store("shared_memory.comp");
    write_text(cache, "a file where the folder should be");
    EXPECT_EQ(compile("navi21", cache).at(0).shaders.size(), 1u);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("is not kept"), std::string::npos) << notices[0];
    fs::remove(cache);
}

TEST_F(ChipCompiler, RefusesAChipThatMesaDoesNotKnow) {
    for (const char* name : {"navi2", "", "--assembly"})
        EXPECT_NE(error_message([&] { find_chip(name); }).find("knows no chip"), std::string::npos) << name;
}

TEST_F(ChipCompiler, NamesThePackageWhereThereIsNoRadv) {
    fs::path lavapipe;
    for (const auto& entry : fs::directory_iterator("/usr/share/vulkan/icd.d"))
        if (entry.path().filename().string().starts_with("lvp_icd")) lavapipe = entry.path();
    if (lavapipe.empty()) GTEST_SKIP() << "no lavapipe in /usr/share/vulkan/icd.d";
    const Environment files("VK_DRIVER_FILES", lavapipe.string()), older("VK_ICD_FILENAMES", lavapipe.string());
    try {
        find_chip("navi21", "");
        FAIL() << "there was a chip";
    } catch (const MachineError& e) {
        EXPECT_NE(std::string(e.what()).find("apt-get install mesa-vulkan-drivers"), std::string::npos) << e.what();
    }
}

TEST(PipelineRecipes, AreReadAsTheyWereWritten) {
    PipelineRecipe recipe{.spirv = {{1, 0xffffffffu}, {3}},
                          .resources = {{"depth", 3, ShaderInterface::Kind::sampler, true}},
                          .push_size = 12,
                          .local_size = {8, 4, 2},
                          .constants = {{7, 0x3f800000u}}};
    recipe.state = {.attachments = {Format::rgba16f, Format::r32f},
                    .stencil = Stencil::Mode::keep_equal,
                    .stencil_value = 5,
                    .depth = PipelineState::Depth{DepthTest::Compare::greater, false, Format::d16}};
    const std::string bytes = bytes_of({recipe, {}});
    const std::vector<PipelineRecipe> read = recipes_of(bytes);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(bytes_of(read), bytes);
    EXPECT_EQ(read[0].spirv, recipe.spirv);
    EXPECT_EQ(read[0].constants, recipe.constants);
    EXPECT_EQ(read[0].local_size, recipe.local_size);
    EXPECT_EQ(read[0].resources.at(0).name, "depth");
    ASSERT_TRUE(read[0].state.depth.has_value());
    EXPECT_EQ(read[0].state.depth->format, Format::d16);
    EXPECT_FALSE(read[1].state.depth.has_value());
    for (const std::string& broken : {std::string(), bytes.substr(0, bytes.size() / 2), std::string("\x80\x01", 2)})
        EXPECT_THROW(recipes_of(broken), Error);
}
