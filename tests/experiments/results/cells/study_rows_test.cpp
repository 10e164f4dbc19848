#include "experiments/results/cells/study_rows.h"
#include "core/elapsed.h"
#include "core/files.h"
#include "experiments/results/verdicts/study_results.h"
#include "experiments/study/progress.h"
#include "experiments/study/workload.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <thread>

TEST(Tables, QuoteWhatNeedsIt) {
    const auto folder = std::filesystem::temp_directory_path() / "tables_test";
    Cell cell;
    cell.times.push_back({.shot = "a.b.1x1",
                          .technique = "v",
                          .point = "x=\"1,2\"",
                          .seed = 3,
                          .stage = "s",
                          .frame = 4,
                          .milliseconds = 0.5,
                          .clock = "host_fence",
                          .foreign_load = 0.25,
                          .disturbed = true});
    write_tables(folder, StudyResults{rows_of({cell})});
    EXPECT_EQ(read_text(folder / "times.csv"),
              "shot,technique,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed\n"
              "a.b.1x1,v,\"x=\"\"1,2\"\"\",3,s,4,0.5,host_fence,0.25,1\n");
    std::filesystem::remove_all(folder);
}

TEST(Tables, GiveSplitsAFileOfTheirOwn) {
    const auto folder = std::filesystem::temp_directory_path() / "splits_test";
    Cell cell;
    cell.splits.push_back({.shot = "s",
                           .frame = "7",
                           .technique = "v",
                           .point = "p",
                           .target = "specular",
                           .mask = "all",
                           .seeds = 3,
                           .mse = 0.75,
                           .bias_squared = 0.5,
                           .variance = 0.25,
                           .variance_low = {},
                           .variance_high = {},
                           .pixels = 9});
    write_tables(folder, StudyResults{rows_of({cell})});
    const std::vector<SplitRow> rows = read_rows<SplitRow>(folder / "splits.csv");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].frame, "7");
    EXPECT_EQ(rows[0].variance, 0.25);
    EXPECT_FALSE(rows[0].variance_low);
    std::filesystem::remove_all(folder);
}

TEST(Workload, LearnsWhatAKindOfWorkTakes) {
    using namespace std::chrono_literals;
    Workload work;
    work.plan("renders", "slow", 2, 1), work.plan("renders", "done before", 98, 1);
    EXPECT_EQ(work.share_done(), 0.0);
    work.start("renders", "done before", 98);
    work.found(0);
    work.start("renders", "slow", 1);
    std::this_thread::sleep_for(20ms);
    work.finish();
    // One of two equal pieces is done, whatever was guessed.
    EXPECT_NEAR(work.share_done(), 0.5, 1e-9);
    work.start("renders", "slow", 1);
    std::this_thread::sleep_for(20ms);
    work.update(1.0);
    EXPECT_NEAR(work.share_done(), 1.0, 1e-9);
}

TEST(Workload, JudgesWhatItHasNotMetByItsLike) {
    using namespace std::chrono_literals;
    Workload work;
    // Guesses are ten times too short: so they are for kinds that were not met, of the same family and of others.
    work.plan("renders", "a", 1, 1), work.plan("renders", "b", 3, 2), work.plan("times", "", 1, 5);
    work.start("renders", "a", 1);
    work.found(10);
    const auto before_start = std::chrono::steady_clock::now();
    work.start("renders", "b", 1);
    const auto after_start = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(20ms);
    const double least = seconds_since(after_start);
    work.finish();
    const double most = seconds_since(before_start);
    // b is measured now, with two units left; times by all corrections together. A busy machine takes longer than
    // asked.
    const auto share = [](double b) { return b / (3 * b + 5 * (10 + b) / 3); };
    EXPECT_GE(work.share_done(), share(least) * (1 - 1e-9));
    EXPECT_LE(work.share_done(), share(most) * (1 + 1e-9));
    work.start("times", "", 1);
    work.found(10);
    EXPECT_NEAR(work.share_done(), 1.0 / 3, 1e-9) << "two units of b are left";
}

TEST(Workload, OverheadIsSpentAndSaysNothingOfTheRest) {
    Workload work;
    work.plan("renders", "a", 2, 3);
    work.add_overhead(6);
    EXPECT_NEAR(work.share_done(), 0.5, 1e-9) << "six seconds are over, two units of three seconds are left";
}

TEST(ProgressEstimate, NeverGoesBackwardsAndIsSmooth) {
    ProgressEstimate estimate;
    estimate.update(1, 0.01);
    EXPECT_FALSE(estimate.left());
    double share = 0, left = 0;
    // Half a minute at a pace of 100 s in all; then it turns out that there is twice as much to do.
    for (int second = 10; second <= 30; ++second) estimate.update(second, second / 100.0);
    EXPECT_NEAR(estimate.left().value(), 70, 1e-9);
    EXPECT_FALSE(estimate.takes_longer());
    share = estimate.share(), left = estimate.left().value();
    for (int second = 31; second < 200; ++second) {
        estimate.update(second, second / 200.0);
        EXPECT_GE(estimate.share(), share);
        EXPECT_LT(std::abs(estimate.left().value() - left), 5) << "in a second";
        share = estimate.share(), left = estimate.left().value();
        if (second == 31) {
            EXPECT_TRUE(estimate.takes_longer());
        }
    }
    EXPECT_NEAR(share, 199.0 / 200, 1e-9);
    EXPECT_NEAR(left, 1, 2);
    EXPECT_FALSE(estimate.takes_longer());
}
