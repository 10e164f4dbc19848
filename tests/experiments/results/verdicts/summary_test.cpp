// Which means over seeds have an interval, what it holds, and where it ends.
#include "experiments/results/verdicts/summary.h"
#include "experiments/results/verdicts/interval.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

std::vector<ResultRow> rows_of(const std::string& metric, const std::vector<double>& values) {
    std::vector<ResultRow> rows;
    for (const double value : values) {
        ResultRow& row = rows.emplace_back();
        row.shot = "s", row.frame = over_frames, row.technique = "v", row.point = "p", row.target = "specular";
        row.metric = metric, row.mask = "all", row.seed = unsigned(rows.size()), row.value = value;
    }
    return rows;
}

MetricSummary summary(const std::vector<ResultRow>& rows) { return summarise(rows).at(0); }
MetricSummary summary_without_seeds(const std::vector<ResultRow>& rows) { return summarise(rows, {{"v", "p"}}).at(0); }

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

TEST(Summary, GivesASingleSeedNoIntervalUnlessAllAreEqual) {
    std::vector<ResultRow> rows = rows_of("mse", {2});
    rows[0].low = 1.5, rows[0].high = 2.5;
    const MetricSummary one = summary(rows), only = summary_without_seeds(rows);
    EXPECT_EQ(one.value, 2.0);
    EXPECT_FALSE(one.low || one.high) << "the reference's noise alone is not what another seed would give";
    EXPECT_EQ(one.interval, interval::one_seed);
    EXPECT_FALSE(one.ranked);
    EXPECT_EQ(only.low, 1.5);
    EXPECT_EQ(only.high, 2.5);
    EXPECT_EQ(only.interval, interval::reference);
    EXPECT_TRUE(only.ranked);
}

TEST(Summary, GivesTheSeedsAloneNoIntervalUnlessTheReferenceIsExact) {
    std::vector<ResultRow> rows = rows_of("flip", {0.11, 0.12, 0.13});
    for (ResultRow& row : rows) row.floor = 0.1;
    EXPECT_FALSE(summary(rows).low || summary(rows).high || summary(rows).ranked);
    EXPECT_EQ(summary(rows).interval, interval::unknown_reference);
    EXPECT_EQ(summary_without_seeds(rows_of("flip", {1})).interval, interval::unknown_reference);
    EXPECT_FALSE(summary(rows).counts_over_scenes()) << "another reference has other noise in it";
    // The seeds are all there is: Student's interval with two degrees of freedom, whose quantile is 4.303.
    for (ResultRow& row : rows) row.floor = 0;
    const MetricSummary exact = summary(rows);
    EXPECT_NEAR(*exact.high - 0.12, 0.043027 / std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(0.12 - *exact.low, 0.043027 / std::sqrt(3.0), 1e-6);
    EXPECT_EQ(exact.interval, interval::seeds);
    EXPECT_TRUE(exact.ranked);
    // One of three seeds was given none.
    std::vector<ResultRow> mse = rows_of("mse", {1, 2, 3});
    for (ResultRow& row : mse) row.floor = 0.1, row.corrected = true;
    mse[0].low = 0.5, mse[0].high = 1.5, mse[1].low = 1.5, mse[1].high = 2.5;
    EXPECT_FALSE(summary(mse).low || summary(mse).ranked);
    EXPECT_EQ(summary(mse).interval, interval::few_paths);
    EXPECT_TRUE(summary(mse).counts_over_scenes()) << "its value has no bias: one scene of several";
    std::vector<ResultRow> flicker = rows_of("flicker", {1, 2});
    EXPECT_EQ(summary(flicker).interval, interval::one_tile);
    for (ResultRow& row : flicker) row.low = 0.5, row.high = 2.5;
    EXPECT_EQ(summary(flicker).interval, interval::pixels_and_seeds);
    for (const char* metric : {"frame_difference", "ghost_share", "cvvdp_0_5_6_video"}) {
        std::vector<ResultRow> of_truth = rows_of(metric, {1, 2});
        EXPECT_EQ(summary(of_truth).interval, interval::unknown_reference) << metric;
        for (ResultRow& row : of_truth) row.low = 0.5, row.high = 2.5;
        EXPECT_EQ(summary(of_truth).interval, interval::reference_and_seeds) << metric;
    }
}

TEST(Summary, ReachesDownByWhatTheNoiseOfTheLightAdds) {
    std::vector<ResultRow> rows = rows_of("mse", {2});
    rows[0].low = 1.7, rows[0].high = 2.3;
    rows[0].lit_noise = 0.25, rows[0].lit_half_width = 0.4;
    const MetricSummary s = summary_without_seeds(rows);
    EXPECT_EQ(s.value, 2.0) << "it may be less, so the value keeps it";
    EXPECT_EQ(s.lit_noise, 0.25);
    EXPECT_NEAR(*s.high, 2 + std::hypot(0.3, 0.4), 1e-12);
    EXPECT_NEAR(*s.low, 2 - std::hypot(0.3, 0.4) - 0.25, 1e-12);
}

TEST(Summary, EndsIntervalsOfErrorsAtZero) {
    const auto low_of = [](const std::string& metric, double value) {
        std::vector<ResultRow> rows = rows_of(metric, {value});
        rows[0].low = value - 0.5, rows[0].high = value + 0.5;
        EXPECT_EQ(*summary_without_seeds(rows).high, value + 0.5) << metric;
        return *summary_without_seeds(rows).low;
    };
    EXPECT_EQ(low_of("mse", 0.25), 0.0);
    EXPECT_EQ(low_of("ghost_length", 0.25), 0.0);
    EXPECT_EQ(low_of("mse", 0.75), 0.25);
    EXPECT_EQ(low_of("mse", -0.125), -0.125) << "an error below 0, by the correction for noise, lies in its interval";
    EXPECT_EQ(low_of("bias", 0.25), -0.25);
}

TEST(Summary, EndsIntervalsWhereNoValueLies) {
    const auto high_of = [](const std::string& metric, std::vector<double> values) {
        std::vector<ResultRow> rows = rows_of(metric, values);
        for (ResultRow& row : rows) row.floor = 0;  // the reference is exact
        if (metric == "flicker_correlation")
            for (ResultRow& row : rows) row.low = *row.value - 0.01, row.high = *row.value + 0.01;
        return *summary(rows).high;
    };
    for (const char* metric : {"ssim", "flip", "flicker_correlation"}) {
        EXPECT_EQ(high_of(metric, {0.7, 0.9}), 1.0) << metric;
        EXPECT_LT(high_of(metric, {0.80, 0.81}), 1.0) << metric;
    }
    EXPECT_GT(high_of("relmse", {0.7, 0.9}), 1.5);
    EXPECT_GT(high_of("energy_ratio", {0.7, 0.9}), 1.5);
}
