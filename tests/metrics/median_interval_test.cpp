#include "metrics/statistics/median_interval.h"

#include <gtest/gtest.h>
#include <vector>

TEST(MedianInterval, IsOfRanksForAnyOrder) {
    std::vector<double> values;
    for (int i = 15; i >= 1; --i) values.push_back(i);
    const Estimate m = median_interval(values);  // falling: as correlated as can be
    EXPECT_EQ(m.value, 8.0);
    EXPECT_EQ(m.low, 1.0);
    EXPECT_EQ(m.high, 15.0);
    // Taking turns about the median: the least factor, 2, and so the ranks 3 and 13 of 15, which of independent values
    // would cover 99.3 %.
    const std::vector<double> turns = {1, 15, 2, 14, 3, 13, 4, 12, 5, 11, 6, 10, 7, 9, 8};
    EXPECT_EQ(median_interval(turns).low, 3.0);
    EXPECT_EQ(median_interval(turns).high, 13.0);
    const std::vector<double> few = {1, 2, 3, 4};
    EXPECT_EQ(median_interval(few).value, 2.5);
    EXPECT_EQ(median_interval(few).low, 1.0);
}
