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

TEST(ProgressEstimate, SharesAreThoseOfTheTimesBesideThem) {
    ProgressEstimate estimate;
    estimate.update(1, 0.01);
    EXPECT_FALSE(estimate.left());
    EXPECT_FALSE(estimate.share());
    // Half a minute at a pace of 100 s in all; then it turns out that there is twice as much to do.
    for (int second = 10; second <= 30; ++second) {
        estimate.update(second, second / 100.0);
        EXPECT_NEAR(estimate.share().value(), second / 100.0, 1e-9);
        EXPECT_NEAR(estimate.left().value(), 100 - second, 1e-9);
    }
    EXPECT_FALSE(estimate.takes_longer());
    double greatest = estimate.share().value();
    bool was_without_share = false;
    for (int second = 31; second < 200; ++second) {
        estimate.update(second, second / 200.0);
        if (second == 31) {
            EXPECT_TRUE(estimate.takes_longer());
        }
        const double by_times = second / (second + estimate.left().value());
        if (!estimate.share()) {
            EXPECT_LT(by_times, greatest - ProgressEstimate::held) << second;
            was_without_share = true;
            continue;
        }
        EXPECT_GE(*estimate.share(), greatest) << second;
        EXPECT_NEAR(*estimate.share(), by_times, ProgressEstimate::held) << second;
        if (second > 75) {
            EXPECT_GT(*estimate.share(), greatest) << "time has passed: " << second;
        }
        greatest = *estimate.share();
    }
    EXPECT_TRUE(was_without_share) << "30 % of 100 s are less of 200 s";
    EXPECT_NEAR(greatest, 199.0 / 200, 0.01);
    EXPECT_NEAR(estimate.left().value(), 1, 2);
    EXPECT_FALSE(estimate.takes_longer());
}

TEST(ProgressEstimate, TakesInANewEstimateWithoutAJump) {
    ProgressEstimate estimate;
    for (int second = 100; second <= 300; ++second) estimate.update(second, second / 1000.0);
    double left = estimate.left().value();
    for (int second = 301; second <= 500; ++second) {
        estimate.update(second, second / 1100.0);  // 100 s more
        EXPECT_LT(std::abs(estimate.left().value() - left), 1.5) << "in a second";
        EXPECT_TRUE(estimate.share()) << "a tenth more is no reason to take it back";
        left = estimate.left().value();
    }
    EXPECT_NEAR(left, 600, 20) << "two time constants";
}

TEST(ProgressEstimate, GoesOnWithTheTimeWhileTheWorkSaysNothing) {
    ProgressEstimate estimate;
    estimate.pass(5);
    EXPECT_FALSE(estimate.share());
    estimate.update(40, 0.4);
    for (int second = 41; second <= 100; ++second) {
        estimate.pass(second);
        EXPECT_NEAR(estimate.left().value(), 100 - second, 1e-9);
        EXPECT_NEAR(estimate.share().value(), second / 100.0, 1e-9);
    }
    estimate.pass(130);
    EXPECT_EQ(estimate.left(), 0);
    EXPECT_EQ(progress_text(estimate, 130), "[ 99 %, 2 min 10 s, 0 s left]");
}

TEST(ProgressEstimate, IsWrittenAsShareTimeAndRest) {
    const auto text = [](double elapsed, double share) {
        ProgressEstimate estimate;
        estimate.update(elapsed, share);
        return progress_text(estimate, elapsed);
    };
    EXPECT_EQ(text(1, 0.01), "[1 s]");
    EXPECT_EQ(text(240, 0.4), "[ 40 %, 4 min 00 s, 6 min 00 s left]");
    EXPECT_EQ(text(599, 0.999), "[ 99 %, 9 min 59 s, 1 s left]");
    EXPECT_EQ(text(942, 942.0 / (942 + 1968)), "[32.3 %, 15 min 42 s, 32 min 48 s left]");
    EXPECT_EQ(text(7200, 1), "[99.9 %, 2 h 00 min, 0 s left]") << "the end is not yet";
    ProgressEstimate doubled;
    // 15 s were expected, 440 s are; of the difference, 1 - exp(-10 / 12.5) enters in 10 s.
    doubled.update(100, 0.8), doubled.update(110, 0.2);
    EXPECT_EQ(progress_text(doubled, 110),
              "[1 min 50 s, 4 min 09 s left, rising: this takes longer than what came before]");
}
