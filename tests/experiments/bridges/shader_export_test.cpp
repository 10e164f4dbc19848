// Exported shaders are the program's own: each file compiles by itself to the SPIR-V of the pipeline that it stands
// for.
#include "experiments/bridges/shader_export/shader_export.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "core/scene/load_scene.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/measuring/costs/compiled_shaders.h"
#include "experiments/study/needs.h"
#include "tests/error_message.h"

#include <SPIRV/GlslangToSpv.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gtest/gtest.h>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <sstream>

namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Spirv = std::vector<unsigned>;

constexpr glm::uvec2 screen(32, 24);

struct ExportedShaders : testing::Test {
    const fs::path folder = fs::temp_directory_path() / "exported_shaders";

    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }

    static Device& device() {
        static Device shared;
        return shared;
    }
    json exported(const PointConfig& point) const {
        export_shaders(device(), {.point = point, .screen = screen, .scene_path = scene_search_path({})}, folder);
        return read_json(folder / "passes.json");
    }
};

/// The pipelines of the point's first two frames, each once, in the order of first use.
std::vector<PipelineRecipe> recipes_of(Device& device, const PointConfig& point) {
    const Shot shot =
        load_shot({.scene = "mirror_pillars", .extent = screen, .frames = {0}, .warm_up = 1, .direct_lit = true},
                  scene_search_path({}));
    const std::unique_ptr<FrameSource> source = scene_source(device, shot, timed_config({point}, 0), true);
    FrameStore store(*source, shot.config, 0);
    const HostImage unused;
    const StagePipelines pipelines = stage_pipelines(
        device, shot, store, [&](const FrameStep&) -> const HostImage& { return unused; }, point, true);
    std::vector<PipelineRecipe> recipes;
    for (const StagePipelines::Entry& entry : pipelines.entries()) recipes.push_back(entry.recipe);
    return recipes;
}

/// Compiles a text alone: no includes, no bindings or locations but its own.
Spirv compiled(const std::string& text, EShLanguage stage) {
    static const bool is_initialised = glslang::InitializeProcess();  // once: it parses all built-in functions
    EXPECT_TRUE(is_initialised);
    glslang::TShader shader(stage);
    const char* const lines = text.c_str();
    shader.setStrings(&lines, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    const auto rules = EShMessages(EShMsgSpvRules | EShMsgVulkanRules);
    glslang::TProgram program;
    Spirv spirv;
    const bool is_valid = shader.parse(GetDefaultResources(), 100, false, rules);
    program.addShader(&shader);
    if (is_valid && program.link(rules))
        glslang::GlslangToSpv(*program.getIntermediate(stage), spirv);
    else
        ADD_FAILURE() << shader.getInfoLog() << program.getInfoLog();
    return spirv;
}

/// Instructions of a module, in which each type, constant and variable has a name made of its definition, its names and
/// its decorations. The exported text leaves out constants, resources and parameters that nothing names, which changes
/// the ids of others and the order of their declarations, and nothing else.
class ComparableModule {
public:
    /// `values`: of specialization constants, by their ids; in the exported text they are the constants' defaults.
    explicit ComparableModule(Spirv spirv, const std::map<uint32_t, uint32_t>& values = {}) {
        std::unordered_map<uint32_t, std::vector<uint32_t>> words;
        for (const auto& [id, value] : values) words[id] = {value};
        spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
        optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(words))
            .RegisterPass(spvtools::CreateEliminateDeadMembersPass());  // so that members have the same indices
        EXPECT_TRUE(optimizer.Run(spirv.data(), spirv.size(), &spirv));
        std::string text;
        EXPECT_TRUE(
            spvtools::SpirvTools(SPV_ENV_VULKAN_1_2).Disassemble(spirv, &text, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER));
        read(text);
    }
    const std::vector<std::string>& lines() const { return lines_; }

private:
    void read(const std::string& text) {
        std::istringstream in(text);
        std::vector<std::string> functions;
        for (std::string line; std::getline(in, line);) {
            std::istringstream words(line);
            std::string first, second;
            words >> first >> second;
            const size_t equals = line.find(" = ");
            const bool is_about =
                first == "OpName" || first == "OpMemberName" || first == "OpDecorate" || first == "OpMemberDecorate";
            if (!functions.empty() || line.find("= OpFunction ") != std::string::npos)
                functions.push_back(line);
            else if (is_about)
                facts_[second].insert(first + line.substr(line.find(second) + second.size()));
            else if (equals != std::string::npos)
                definitions_[first] = line.substr(equals + 3);
            else if (first != "OpEntryPoint")  // which lists variables that nothing uses
                lines_.push_back(named(line));
        }
        for (const std::string& line : functions) lines_.push_back(named(line));
    }

    std::string named(const std::string& line) {
        const bool is_access = line.find("OpAccessChain") != std::string::npos;
        std::string text;
        size_t at = 0;
        for (size_t id; (id = line.find('%', at)) != std::string::npos;) {
            const size_t end = std::min(line.find(' ', id), line.size());
            const std::string name = line.substr(id, end - id);
            text += line.substr(at, id - at) + (is_access ? index_or_name_of(name) : name_of(name));
            at = end;
        }
        return text + line.substr(at);
    }

    /// Removing members gives some of the others unsigned indices.
    std::string index_or_name_of(const std::string& id) {
        const auto definition = definitions_.find(id);
        if (definition == definitions_.end() || !definition->second.starts_with("OpConstant %")) return name_of(id);
        std::istringstream words(definition->second);
        std::string constant, type, value;
        words >> constant >> type >> value;
        return definitions_.at(type).starts_with("OpTypeInt 32") ? value : name_of(id);
    }

    /// Of a global: the hash of all that is said of it. Else a number in the order of first use.
    std::string name_of(const std::string& id) {
        const auto [known, is_new] = names_.try_emplace(id);
        if (!is_new) return known->second;
        const auto global = definitions_.find(id);
        std::string facts;
        for (const std::string& fact : facts_[id]) facts += fact + '\n';
        ContentHash hash;
        hash.add(global == definitions_.end() ? std::to_string(locals_++) : named(global->second));
        hash.add(facts);
        return names_[id] = '%' + hash.hex();
    }

    std::map<std::string, std::string> definitions_, names_;  ///< by id
    std::map<std::string, std::set<std::string>> facts_;      ///< names and decorations, by id
    size_t locals_ = 0;
    std::vector<std::string> lines_;
};

void expect_same(const fs::path& file, EShLanguage stage, const Spirv& own, const PipelineRecipe& recipe) {
    const std::vector<std::string> exported = ComparableModule(compiled(read_text(file), stage)).lines();
    EXPECT_GT(exported.size(), 10u);
    EXPECT_TRUE(exported == ComparableModule(own, recipe.constants).lines()) << file << " is not the program's shader";
}

}  // namespace

TEST_F(ExportedShaders, CompileAloneToTheProgramsSpirv) {
    std::set<std::string> compared;  // points share passes
    bool has_fragment_passes = false;
    for (const PointConfig& point : {single_point("composed_ssr"),
                                     single_point("composed_ssr", "", {{"tracer", "cells"}, {"previous_frame", true}}),
                                     single_point("amd_sssr")}) {
        SCOPED_TRACE(point.technique + ' ' + point.point);
        const json files = exported(point).at("files");
        const std::vector<PipelineRecipe> recipes = recipes_of(device(), point);
        ASSERT_EQ(files.size(), recipes.size());
        for (size_t i = 0; i < recipes.size(); ++i) {
            const PipelineRecipe& recipe = recipes[i];
            if (!compared.insert(bytes_of({recipe})).second) continue;
            const fs::path file = folder / files[i].at("name").get<std::string>();
            expect_same(file, recipe.is_compute ? EShLangCompute : EShLangFragment, recipe.spirv.back(), recipe);
            has_fragment_passes |= !recipe.is_compute;
            if (!recipe.is_compute)
                expect_same(folder / files[i].at("vertex").get<std::string>(), EShLangVertex, recipe.spirv.front(),
                            recipe);
        }
    }
    EXPECT_TRUE(has_fragment_passes) << "keep_lit, of previous_frame";
}

TEST_F(ExportedShaders, AreDescribed) {
    const json made = exported(single_point("composed_ssr"));
    const auto named = [](const json& list, const std::string& name) {
        for (const json& one : list)
            if (one.value("name", "") == name || one.value("stage", "") == name) return one;
        ADD_FAILURE() << "nothing is called " << name;
        return json();
    };
    const json accumulated = named(made.at("images"), "accumulated");
    EXPECT_EQ(accumulated.at("is_history"), true);
    EXPECT_EQ(accumulated.at("share"), "W x H");
    EXPECT_EQ(named(made.at("buffers"), "directions").at("share"), "16 * ceil(W/2) * ceil(H/2)");
    const json trace = named(made.at("steps"), "composed_ssr/trace");
    EXPECT_EQ(trace.at("groups"), json({2, 2, 1}));
    EXPECT_EQ(trace.at("local_size"), json({8, 8, 1}));
    const json blocks = named(made.at("files"), "composed_ssr/trace").at("blocks");
    const json extent = named(named(blocks, "Camera").at("members"), "camera.extent");
    EXPECT_EQ(extent.at("offset"), 10 * 64);
    EXPECT_EQ(extent.at("meaning"), "width, height, 1 / width, 1 / height (pixels)");
    EXPECT_NE(named(made.at("inputs"), "motion").at("meaning"), "");
    EXPECT_TRUE(fs::is_regular_file(folder / "LICENSE"));
    EXPECT_TRUE(fs::is_regular_file(folder / "README.md"));
}

TEST_F(ExportedShaders, ReplaceOnlyAnEarlierExport) {
    exported(single_point("composed_ssr"));
    EXPECT_TRUE(fs::exists(folder / "03_composed_ssr_trace.comp"));
    write_text(folder / "own.txt", "of the user");
    exported(single_point("amd_sssr"));
    EXPECT_FALSE(fs::exists(folder / "03_composed_ssr_trace.comp"));
    EXPECT_TRUE(fs::exists(folder / "own.txt"));
    const auto message = [&] { return error_message([&] { check_export_folder(folder); }); };
    EXPECT_EQ(message(), "no error");
    fs::remove(folder / "passes.json");
    EXPECT_NE(message().find("is not empty, and no export"), std::string::npos) << message();
}

TEST_F(ExportedShaders, RefuseWhatNoEngineHas) {
    for (const auto& [point, says] :
         {std::pair(single_point("none"), "has no passes of its own"),
          std::pair(single_point("composed_ssr", "", {{"tracer", "exact_scene"}}), "choose another tracer")}) {
        const std::string message = error_message([&] { exported(point); });
        EXPECT_NE(message.find(says), std::string::npos) << message;
        EXPECT_FALSE(fs::exists(folder));
    }
}
