#include "core/error.h"
#include "core/gpu/shader.h"
#include "tests/variants/variant_fixture.h"

#include <filesystem>
#include <map>

namespace {

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Registry, NamesTheNearestVariant) {
    EXPECT_EQ(message_of([] { make_variant("mcguire_dad"); }),
              "unknown variant 'mcguire_dad'; did you mean 'mcguire_dda'?");
    EXPECT_EQ(message_of([] {
                  make_variant("mcguire_dda", {{"thicknes", 1}});
              }),
              "variant 'mcguire_dda': unknown parameter 'thicknes'; did you mean 'thickness'?");
    EXPECT_EQ(message_of([] {
                  make_variant("mcguire_dda", {{"stride", 0}});
              }),
              "variant 'mcguire_dda': parameter 'stride' = 0 is outside of its range: [1, 64]");
    EXPECT_EQ(message_of([] { make_variant("mcguire_dda", {}, "corse"); }),
              "unknown preset of variant 'mcguire_dda': 'corse'; did you mean 'coarse'?");
    EXPECT_EQ(message_of([] { make_variant("none", {}, "fast"); }),
              "unknown preset of variant 'none': 'fast'; there are none");
}

TEST(Registry, AppliesPresetsBeforeParameters) {
    const auto variant = make_variant("mcguire_dda", {{"stride", 7}}, "coarse");
    EXPECT_EQ(variant->params.values().at("stride"), 7);
    EXPECT_EQ(variant->params.values().at("refine"), true);
}

TEST(Registry, DescribesEveryVariantInFull) {
    std::vector<std::string> facts;
    for (const SceneFact& fact : list_facts(Scene{}, SceneFacts{})) facts.push_back(fact.name);
    for (const VariantEntry& entry : variant_table()) {
        EXPECT_FALSE(entry.title.empty() || entry.source.empty() || entry.description.empty()) << entry.name;
        for (const std::string& need : entry.needs)
            EXPECT_NE(std::ranges::find(facts, need), facts.end()) << entry.name << " needs " << need;
        for (const Preset& preset : entry.presets)
            EXPECT_NO_THROW(make_variant(entry.name, {}, preset.name)) << preset.name;
        const std::unique_ptr<Variant> variant = entry.create();
        for (const Parameter& p : variant->params)
            EXPECT_FALSE(p.doc.empty() || p.source.empty()) << entry.name << ": " << p.name;
    }
}

/// Papers compare techniques by the names of their parameters.
TEST(Registry, ParametersOfOneNameAreOfOneUnitAndKind) {
    std::map<std::string, std::pair<std::string, const Parameter*>> known;
    std::vector<std::unique_ptr<Variant>> variants;
    unsigned shared = 0;
    for (const VariantEntry& entry : variant_table()) {
        variants.push_back(entry.create());
        for (const Parameter& p : variants.back()->params) {
            const auto [first, is_new] = known.try_emplace(p.name, entry.name, &p);
            if (is_new) continue;
            ++shared;
            const std::string where = p.name + " of " + entry.name + " and " + first->second.first;
            EXPECT_EQ(p.unit, first->second.second->unit) << where;
            EXPECT_EQ(p.glsl_type, first->second.second->glsl_type) << where;
            EXPECT_EQ(p.choices, first->second.second->choices) << where;
        }
    }
    EXPECT_GE(shared, 10u);
}

/// All parameter sets of one variant share its folder's shaders.
TEST(Registry, CompilesEveryShaderOfEveryVariant) {
    size_t count = 0;
    for (const VariantEntry& entry : variant_table())
        for (const auto& file :
             std::filesystem::recursive_directory_iterator(SSRLAB_SOURCE_DIR "/variants/" + entry.name)) {
            if (file.path().extension() != ".comp" && file.path().extension() != ".frag") continue;
            const std::string name = std::filesystem::relative(file.path(), SSRLAB_SOURCE_DIR "/variants");
            EXPECT_NO_THROW(compile(name, "", shader_prelude(entry.create()->params))) << name;
            ++count;
        }
    EXPECT_GE(count, 2u);
}

}  // namespace
