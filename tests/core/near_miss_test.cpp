#include "core/near_miss.h"

#include <gtest/gtest.h>
#include <vector>

TEST(NearMiss, SuggestsWhatWasProbablyMeant) {
    const std::vector<std::string> names = {"thickness", "stride", "max_steps"};
    EXPECT_EQ(nearest_name("thicknes", names), "thickness");
    EXPECT_EQ(nearest_name("strdie", names), "stride");
    EXPECT_EQ(nearest_name("roughness_cutoff", names), "");
    EXPECT_EQ(suggestion("zzz", names), "; known are: thickness, stride, max_steps");
}
