#include "core/error.h"
#include "core/files.h"
#include "core/gpu/pipelines/shader.h"
#include "tests/error_message.h"
#include "tests/variants/recommended_presets.h"
#include "tests/variants/technique_fixture.h"
#include "variants/declared/declared_entry.h"
#include "variants/denoisers/denoisers.h"
#include "variants/passes/check_frames.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace {

TEST(Registry, NamesTheNearestTechnique) {
    EXPECT_EQ(error_message([] { make_technique("mcguire_dad"); }),
              "unknown technique 'mcguire_dad'; did you mean 'mcguire_dda'?");
    EXPECT_EQ(error_message([] {
                  make_technique("mcguire_dda", {{"thicknes", 1}});
              }),
              "technique 'mcguire_dda': unknown parameter 'thicknes'; did you mean 'dda.thickness'?");
    EXPECT_EQ(error_message([] {
                  make_technique("mcguire_dda", {{"dda.stride", 0}});
              }),
              "technique 'mcguire_dda': parameter 'dda.stride' = 0 is outside of its range: [1, 64]");
    EXPECT_EQ(error_message([] { make_technique("mcguire_dda", {}, "corse"); }),
              "unknown preset of technique 'mcguire_dda': 'corse'; did you mean 'coarse'?");
    EXPECT_EQ(error_message([] { make_technique("none", {}, "fast"); }),
              "unknown preset of technique 'none': 'fast'; there are none");
}

TEST(Registry, AppliesPresetsBeforeParameters) {
    const auto technique = make_technique("mcguire_dda", {{"dda.stride", 7}}, "coarse");
    EXPECT_EQ(technique->params.values().at("dda.stride"), 7);
    EXPECT_EQ(technique->params.values().at("dda.refine"), true);
}

/// What `ssrlab tune` writes becomes presets by a copy of its file; a copy beside the wrong technique is an error.
TEST(Registry, TakesPresetsThatASearchFound) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "tuned_presets.json";
    const auto add = [&](TechniqueEntry entry, const std::string& preset) {
        write_text(file, R"({"presets": [)" + preset + "]}");
        add_tuned_presets(entry, file);
        return entry.presets.back();
    };
    const TechniqueEntry& dda = find_technique("mcguire_dda");
    const Preset found = add(dda, R"({"technique": "mcguire_dda", "name": "best_4x", "description": "made up",
                                      "parameters": {"dda.stride": 2}})");
    EXPECT_EQ(found.name, "best_4x");
    EXPECT_EQ(found.meaning, "made up");
    EXPECT_EQ(found.parameters, nlohmann::json({{"dda.stride", 2}}));
    const std::string rest = R"("description": "", "parameters": {}})";
    EXPECT_EQ(error_message([&] { add(dda, R"({"technique": "amd_sssr", "name": "best_4x", )" + rest); }),
              file.string() + ":1:15: presets[0]: 'amd_sssr' is not 'mcguire_dda'");
    EXPECT_EQ(error_message([&] { add(dda, R"({"technique": "mcguire_dda", "name": "coarse", )" + rest); }),
              file.string() + ":1:43: presets[0]: 'mcguire_dda' has a preset 'coarse' already");
}

TEST(Registry, DescribesEveryTechniqueInFull) {
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        EXPECT_FALSE(entry.title.empty() || entry.source.empty() || entry.description.empty()) << entry.name;
        for (const Preset& preset : entry.presets)
            EXPECT_NO_THROW(make_technique(entry.name, {}, preset.name)) << preset.name;
        const std::unique_ptr<Technique> technique = entry.create();
        for (const Parameter& p : technique->params)
            EXPECT_FALSE(p.doc.empty() || p.source.empty()) << entry.name << ": " << p.name;
    }
}

/// Papers compare techniques by the names of their parameters.
TEST(Registry, ParametersOfOneNameAreOfOneUnitAndKind) {
    std::map<std::string, std::pair<std::string, const Parameter*>> known;
    std::vector<std::unique_ptr<Technique>> techniques;
    unsigned shared = 0;
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        techniques.push_back(entry.create());
        for (const Parameter& p : techniques.back()->params) {
            const auto [first, is_new] = known.try_emplace(p.name, entry.name, &p);
            if (is_new) continue;
            ++shared;
            const std::string where = p.name + " of " + entry.name + " and " + first->second.first;
            EXPECT_EQ(p.unit, first->second.second->unit) << where;
            EXPECT_EQ(p.glsl_type, first->second.second->glsl_type) << where;
            // One may know more of them, behind those that both have.
            const std::vector<std::string>&known_choices = first->second.second->choices, &choices = p.choices;
            const size_t common = std::min(known_choices.size(), choices.size());
            EXPECT_TRUE(std::equal(choices.begin(), choices.begin() + common, known_choices.begin())) << where;
            EXPECT_EQ(choices.empty(), known_choices.empty()) << where;
        }
    }
    EXPECT_GE(shared, 10u);
}

/// Of every technique of ssrlab but `none`, which has no shader.
void expect_all_techniques(const std::set<std::string>& compiled) {
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        EXPECT_EQ(compiled.contains(entry.name), entry.name != "none") << entry.name;
    }
}

/// All parameter sets of one technique share its folder's shaders.
TEST(Registry, CompilesEveryShaderOfEveryTechnique) {
    std::set<std::string> compiled;
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        for (const auto& file :
             std::filesystem::recursive_directory_iterator(SSRLAB_SOURCE_DIR "/variants/" + entry.name)) {
            if (file.path().extension() != ".comp" && file.path().extension() != ".frag") continue;
            const std::string name = std::filesystem::relative(file.path(), SSRLAB_SOURCE_DIR "/variants");
            const std::unique_ptr<Technique> technique = entry.create();
            EXPECT_NO_THROW(compile(name, "", shader_prelude(technique->params), technique->shader_includes())) << name;
            compiled.insert(entry.name);
        }
    }
    expect_all_techniques(compiled);
}

/// Any tracer runs in any technique: their names, and those of the technique, stay apart.
TEST(Registry, CompilesEveryTechniqueWithEveryTracer) {
    std::set<std::string> compiled;
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        for (const TracerEntry& tracer : tracer_table()) {
            nlohmann::json chosen = nlohmann::json::object();
            const std::unique_ptr<Technique> default_technique = entry.create();
            for (const Parameter& p : default_technique->params)
                if (std::ranges::count(p.choices, tracer.name)) chosen[p.name] = tracer.name;
            const std::unique_ptr<Technique> technique = make_technique(entry.name, chosen);
            for (const auto& file : std::filesystem::directory_iterator(SSRLAB_SOURCE_DIR "/variants/" + entry.name)) {
                if (file.path().extension() != ".comp" && file.path().extension() != ".frag") continue;
                if (read_text(file.path()).find("tracer\"\n") == std::string::npos) continue;
                const std::string name = std::filesystem::relative(file.path(), SSRLAB_SOURCE_DIR "/variants");
                const auto compiles_as = [&](ShaderLanguage language) {
                    compile(name, "", shader_prelude(technique->params, language), technique->shader_includes(),
                            language);
                };
                EXPECT_NO_THROW(compiles_as(ShaderLanguage::vulkan)) << name << ", " << tracer.name;
                if (tracer.fits_webgl2) {  // others are answered by the scene already
                    nlohmann::json asked = chosen;
                    asked["exact_rays"] = "random";
                    if (std::ranges::count(technique->params, "hierarchy.min_traversal_occupancy", &Parameter::name))
                        asked["hierarchy.min_traversal_occupancy"] = 0;
                    const std::unique_ptr<Technique> asking = make_technique(entry.name, asked);
                    EXPECT_NO_THROW(compile(name, "", shader_prelude(asking->params), asking->shader_includes()))
                        << name << ", " << tracer.name << ", exact_rays";
                }
                if (entry.limits.api == Limits::webgl2 && tracer.fits_webgl2) {
                    EXPECT_NO_THROW(compiles_as(ShaderLanguage::webgl2)) << name << ", " << tracer.name;
                }
                compiled.insert(entry.name);
            }
        }
    }
    expect_all_techniques(compiled);
}

/// Of the tracers and denoisers that it has, whose own are others.
TEST(Registry, ATechniqueBeginsWithItsOwnDefaults) {
    const nlohmann::json composed = make_technique("composed_ssr")->params.values(),
                         amd = make_technique("amd_sssr")->params.values();
    EXPECT_EQ(composed.at("lobe"), "visible_normals");
    EXPECT_EQ(composed.at("dda.thickness"), 0);
    EXPECT_EQ(amd.at("hierarchy.judgement"), "amd");
    EXPECT_EQ(amd.at("hierarchy.min_traversal_occupancy"), 4);
}

TEST(Registry, EveryFrameOfOwnTechniquesAndDenoisersIsSound) {
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;
        const auto declaration = read_technique(entry.folder->path, false).declaration;
        EXPECT_NO_THROW(check_frames(*declaration, make_technique(entry.name)->params)) << entry.name;
    }
    for (const DenoiserEntry& entry : denoiser_table())
        EXPECT_NO_THROW(check_frames(*entry.passes, Denoiser(entry).params)) << entry.name;
}

/// A NaN or Inf of a G-buffer stays in its pixel with every preset that is recommended.
TEST(Registry, RecommendedPresetsRepairTheirInputs) {
    size_t count = 0;
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        for (const Preset& preset : entry.presets) {
            if (!is_recommended(preset)) continue;
            EXPECT_EQ(preset.parameters.value("repair_inputs", false), true) << entry.name << ":" << preset.name;
            ++count;
        }
    }
    EXPECT_GE(count, 20u);
    EXPECT_EQ(make_technique("composed_ssr", {}, "repaired")->params.values(),
              make_technique("composed_ssr", {}, "corrected")->params.values());
}

}  // namespace
