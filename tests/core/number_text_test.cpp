#include "core/number_text.h"

#include <gtest/gtest.h>

TEST(NumberText, ProbabilitiesNeverReadAsCertain) {
    EXPECT_EQ(probability_text(0.685), "0.69");
    EXPECT_EQ(probability_text(0.994), "0.99");
    EXPECT_EQ(probability_text(0.996), "above 0.99");
    EXPECT_EQ(probability_text(1), "above 0.99");
    EXPECT_EQ(probability_text(0.006), "0.01");
    EXPECT_EQ(probability_text(0), "below 0.01");
}

TEST(NumberText, KeepsSignificantDigitsWithoutZerosAtTheEnd) {
    EXPECT_EQ(number_text(1.5), "1.5");
    EXPECT_EQ(number_text(0.000023456789, 2), "2.3e-05");
    EXPECT_EQ(percent_text(0.05), "5 %");
    EXPECT_EQ(ray_rate_text(1'240'000), "1.2 Mray/s");
}
