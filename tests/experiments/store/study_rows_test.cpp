#include "experiments/store/study_rows.h"
#include "core/files.h"
#include "experiments/evaluation/summary.h"
#include "experiments/run/workload.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <thread>

TEST(Tables, QuoteWhatNeedsIt) {
    const auto folder = std::filesystem::temp_directory_path() / "ssrlab_tables_test";
    Cell cell;
    cell.times.push_back({.shot = "a.b.1x1",
                          .variant = "v",
                          .point = "x=\"1,2\"",
                          .seed = 3,
                          .stage = "s",
                          .frame = 4,
                          .milliseconds = 0.5,
                          .clock = "host_fence",
                          .foreign_load = 0.25,
                          .is_disturbed = true});
    write_tables(folder, rows_of({cell}));
    EXPECT_EQ(read_text(folder / "times.csv"),
              "shot,variant,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed\n"
              "a.b.1x1,v,\"x=\"\"1,2\"\"\",3,s,4,0.5,host_fence,0.25,1\n");
    std::filesystem::remove_all(folder);
}

TEST(Tables, GiveSplitsAFileOfTheirOwn) {
    const auto folder = std::filesystem::temp_directory_path() / "ssrlab_splits_test";
    Cell cell;
    cell.splits.push_back({.shot = "s",
                           .frame = "7",
                           .variant = "v",
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
    write_tables(folder, rows_of({cell}));
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
    work.plan("slow", 2, 1), work.plan("done before", 98, 1);
    EXPECT_EQ(work.share_done(), 0.0);
    work.start("done before", 98);
    work.skip();
    work.start("slow", 1);
    std::this_thread::sleep_for(20ms);
    work.finish();
    // One of two equal pieces is done, whatever was guessed.
    EXPECT_NEAR(work.share_done(), 0.5, 1e-9);
    work.start("slow", 1);
    std::this_thread::sleep_for(20ms);
    work.update(1.0);
    EXPECT_NEAR(work.share_done(), 1.0, 1e-9);
}
