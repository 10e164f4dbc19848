#include "core/near_miss.h"

#include <gtest/gtest.h>
#include <vector>

TEST(NearMiss, SuggestsWhatWasProbablyMeant) {
    const std::vector<std::string> names = {"thickness", "stride", "max_steps"};
    EXPECT_EQ(nearest_name("thicknes", names), "thickness");
    EXPECT_EQ(nearest_name("strdie", names), "stride");
    EXPECT_EQ(nearest_name("roughness_cutoff", names), "");
    EXPECT_EQ(nearest_name("thickness", std::vector<std::string>{"stride", "relative_thickness"}),
              "relative_thickness");
    EXPECT_EQ(nearest_name("max", std::vector<std::string>{"stride", "max_rays_of_a_pixel"}), "");
    EXPECT_EQ(suggestion("zzz", names), "; known are: thickness, stride, max_steps");
}

TEST(NearMiss, ManyNamesAreNoList) {
    std::vector<std::string> names;
    for (int i = 0; i < 130; ++i) names.push_back("parameter_" + std::to_string(i));
    EXPECT_EQ(suggestion("zzz", names, "ssrlab describe TECHNIQUE").substr(0, 36),
              "; the nearest of 130 names are: para");
    EXPECT_TRUE(suggestion("zzz", names, "ssrlab describe X").ends_with("; `ssrlab describe X` lists all"));
    EXPECT_LT(suggestion("zzz", names).size(), 120u);
    names.push_back("zebra");
    EXPECT_NE(suggestion("zzz", names).find("names are: zebra"), std::string::npos) << suggestion("zzz", names);
    EXPECT_LT(suggestion(std::string(300'000, 'z'), names).size(), 120u);
}

TEST(NearMiss, LongNamesAreNearNone) {
    // Their distance would take 90 GB and 10^10 steps.
    const std::string name(300'000, 'a');
    const std::vector<std::string> names = {name + "b", "stride"};
    EXPECT_EQ(nearest_name(name, names), "");
    EXPECT_LT(suggestion("strides_of_a_march", names).size(), 400u);
}

TEST(NearMiss, LongTextsAreCutBetweenCharacters) {
    EXPECT_EQ(shortened(std::string(300, 'a')), std::string(300, 'a'));
    std::string umlauts;
    for (int i = 0; i < 1000; ++i) umlauts += "\u00e4";
    for (const std::string& text : {umlauts, "a" + umlauts}) {
        const std::string cut = shortened(text);
        EXPECT_LE(cut.size(), 305u);
        EXPECT_TRUE(text.starts_with(cut.substr(0, cut.find(" ... "))));
        EXPECT_EQ((cut.size() - 5 - (text.front() == 'a')) % 2, 0u) << "half a character";
    }
}
