#include "core/former_names.h"

#include <gtest/gtest.h>

namespace {

using nlohmann::json;

JsonDocument taken(const json& value, FormerNames which, std::map<std::string, JsonPlace> places = {}) {
    JsonDocument document{value, std::move(places)};
    take_former_names(document, which);
    return document;
}

}  // namespace

TEST(FormerNames, OfAStudyAreReadAsThoseThatItHas) {
    const json former = {{"variants", {{{"variant", "composed_ssr"}, {"sweep", {{"resolve", {"mean", "blur"}}}}}}},
                         {"tables", {{{"rows", {"variant", "scene"}}, {"where", {{"against_variant", "none"}}}}}}};
    const json present = {
        {"techniques", {{{"technique", "composed_ssr"}, {"sweep", {{"denoiser", {"mean", "blur"}}}}}}},
        {"tables", {{{"rows", {"technique", "scene"}}, {"where", {{"against_technique", "none"}}}}}}};
    EXPECT_EQ(taken(former, FormerNames::of_study).value, present);
    EXPECT_EQ(taken(present, FormerNames::of_study).value, present);
}

TEST(FormerNames, KeepPlaces) {
    const json former = {{"variants", {{{"variant", "none"}}}}, {"shots", {{{"scene", "fence"}}}}};
    const std::map<std::string, JsonPlace> places = {{"/variants", {"a.json", 2, 3}},
                                                     {"/variants/0/variant", {"a.json", 3, 5}},
                                                     {"/shots/0/scene", {"a.json", 7, 1}}};
    const auto found = taken(former, FormerNames::of_study, places).places;
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found.at("/techniques").line, 2u);
    EXPECT_EQ(found.at("/techniques/0/technique").line, 3u);
    EXPECT_EQ(found.at("/shots/0/scene").line, 7u);
}

/// A technique may have a parameter `variant`, a scene what it likes; and whoever writes both names means both.
TEST(FormerNames, OfOthersAreLeftAlone) {
    const json own = {{"techniques", {{{"technique", "./mine"}, {"parameters", {{"variant", 3}}}}}},
                      {"shots", {{{"scene", "car"}, {"variant", "red"}}}}};
    EXPECT_EQ(taken(own, FormerNames::of_study).value, own);
    const json texts = {{"techniques", {{{"external", "resolves/frames"}}}},
                        {"rows", {{{"technique", "resolve"}, {"point", "variant"}}}},
                        {"tune", {{"program", {"./render"}}, {"axes", {{"resolve", {1, 2}}, {"variant", {3}}}}}}};
    EXPECT_EQ(taken(texts, FormerNames::of_study).value, texts) << "a path, rows of a cell, settings of a program";
    const json both = {{"variants", 1}, {"techniques", 2}};
    EXPECT_EQ(taken(both, FormerNames::of_study).value, both);
    const json preset = {{"presets", {{{"name", "a"}, {"parameters", {{"variant", 3}}}}}}};
    EXPECT_EQ(taken(preset, FormerNames::of_technique).value, preset);
}

TEST(FormerNames, OfATechniqueAndItsFiles) {
    const json former = {{"resolve", {{"default", "mean"}}}}, present = {{"denoiser", {{"default", "mean"}}}};
    EXPECT_EQ(taken(former, FormerNames::of_technique).value, present);
    EXPECT_EQ(present_path("resolves/ray.glsl"), "denoisers/ray.glsl");
    EXPECT_EQ(present_path("unresolves/ray.glsl"), "unresolves/ray.glsl");
}

TEST(FormerNames, OfCommands) {
    EXPECT_EQ(present_word("variants", {"list"}), "techniques");
    EXPECT_EQ(present_word("resolves", {"list"}), "denoisers");
    EXPECT_EQ(present_word("variants", {"report"}), "variants") << "a folder";
    EXPECT_EQ(present_word("--variants", {"needs"}), "--techniques");
    EXPECT_EQ(present_word("--variants=none", {"needs"}), "--techniques=none");
    EXPECT_EQ(present_word("variant=none", {"run", "study.json", "--cells"}), "technique=none");
    EXPECT_EQ(present_word("variant=none", {"run"}), "variant=none") << "a folder";
}
