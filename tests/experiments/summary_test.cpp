// Which means over seeds have an interval, and where it ends.
#include "experiments/summary.h"

#include <gtest/gtest.h>

namespace {

std::vector<ResultRow> rows_of(const std::string& metric, const std::vector<double>& values) {
    std::vector<ResultRow> rows;
    for (const double value : values) {
        ResultRow& row = rows.emplace_back();
        row.shot = "s", row.frame = "all", row.variant = "v", row.point = "p", row.target = "specular";
        row.metric = metric, row.mask = "all", row.seed = unsigned(rows.size()), row.value = value;
    }
    return rows;
}

MetricSummary summary(const std::vector<ResultRow>& rows) { return summarise(rows).at(0); }

}  // namespace

TEST(Summary, GivesNoIntervalWhereARowHasNoUpperEnd) {
    std::vector<ResultRow> ghosts = rows_of("ghost_length", {20, 21, 20, 20});
    for (ResultRow& row : ghosts) row.low = 5;
    EXPECT_EQ(summary(ghosts).value, 20.25);
    EXPECT_FALSE(summary(ghosts).low || summary(ghosts).high) << "the seeds agree by chance: each may last for ever";
    for (size_t i = 0; i < 3; ++i) ghosts[i].high = 40;
    EXPECT_FALSE(summary(ghosts).low || summary(ghosts).high) << "one without an end is enough";
    ghosts[3].high = 40;
    EXPECT_LE(*summary(ghosts).low, 5.0);
    EXPECT_GE(*summary(ghosts).high, 40.0);
    for (ResultRow& row : ghosts) row.floor = 0;
    ghosts[0].low.reset();
    EXPECT_FALSE(summary(ghosts).low || summary(ghosts).high) << "a floor of 0 does not close it";
}

TEST(Summary, TakesNoReferenceForExactThatDoesNotSaySo) {
    std::vector<ResultRow> rows = rows_of("flicker", {1, 2, 3});
    EXPECT_FALSE(summary(rows).low || summary(rows).high);
    for (ResultRow& row : rows) row.floor = 0;
    EXPECT_TRUE(summary(rows).low && summary(rows).high);
}

TEST(Summary, EndsIntervalsOfErrorsAtZero) {
    const auto low_of = [](const std::string& metric, double value) {
        std::vector<ResultRow> rows = rows_of(metric, {value});
        rows[0].low = value - 0.5, rows[0].high = value + 0.5;
        EXPECT_EQ(*summary(rows).high, value + 0.5) << metric;
        return *summary(rows).low;
    };
    EXPECT_EQ(low_of("mse", 0.25), 0.0);
    EXPECT_EQ(low_of("ghost_length", 0.25), 0.0);
    EXPECT_EQ(low_of("mse", 0.75), 0.25);
    EXPECT_EQ(low_of("mse", -0.125), -0.125) << "an error below 0, by the correction for noise, lies in its interval";
    EXPECT_EQ(low_of("bias", 0.25), -0.25);
}
