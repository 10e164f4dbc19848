// What is said of a study's time before it starts.
#include "experiments/study/plan/expected_time.h"
#include "tests/error_message.h"
#include "tests/experiments/study/study_fixture.h"

namespace {

TEST(ExpectedTime, HasAnIntervalThatHoldsIt) {
    for (const double seconds : {1.0, 100.0, 1e5})
        for (const ExpectedRange range : {range_of_seconds(seconds), range_of_processor_seconds(seconds)}) {
            EXPECT_GT(range.low, 0);
            EXPECT_LT(range.low, seconds);
            EXPECT_GT(range.high, seconds);
        }
    EXPECT_EQ(with_range(245, {150, 4000}), "4 min 05 s (2 min 30 s to 1 h 06 min)");
}

TEST(ExpectedTime, SaysWhatOtherProgramsDoToIt) {
    const ExpectedTime time{.seconds = 240, .processor_seconds = 400};
    const std::string said = "The study takes " + with_range(240, range_of_seconds(240)) + ", and " +
                             with_range(400, range_of_processor_seconds(400)) + " of processor time. ";
    for (const std::optional<double> quiet : {std::optional<double>(), std::optional(0.04)})
        EXPECT_EQ(expected_time_text(time, quiet, 2),
                  said + "Other programs lengthen the time, and hardly the processor time.");
    EXPECT_EQ(expected_time_text(time, 0.25, 8).substr(said.size(), 50),
              "Other programs now take 2.0 of 8 processors. Witho");
}

/// A study in which nothing is done yet, and what is asked before it starts.
struct LongStudy : StudyTest {
    unsigned asked = 0;
    std::string said;  ///< on the standard output

    /// What it fails with, or "no error".
    std::string start(double names_after, bool answer) {
        const Config study = config("\"fence\"");
        testing::internal::CaptureStdout();
        const std::string failed = error_message([&] {
            run_study(study, {.out = folder / "out",
                              .cache = folder / "cache",
                              .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                              .names_after = names_after,
                              .confirm = [&] {
                                  ++asked;
                                  return answer;
                              }});
        });
        said = testing::internal::GetCapturedStdout();
        return failed;
    }
};

TEST_F(LongStudy, IsNamedAndNotStartedAgainstOnesWill) {
    EXPECT_EQ(start(0, false), "the study was not started; `ssrlab plan` shows what takes its time");
    EXPECT_EQ(asked, 1u);
    EXPECT_NE(said.find("This study takes "), std::string::npos) << said;
    EXPECT_NE(said.find(" plan "), std::string::npos) << said;
    EXPECT_FALSE(fs::exists(folder / "out" / "study.json"));
    EXPECT_FALSE(fs::exists(folder / "out" / "cells"));
}

TEST_F(LongStudy, StartsWhenConfirmedAndIsNotNamedAgainOnceItIsDone) {
    EXPECT_EQ(start(0, true), "no error");
    EXPECT_EQ(asked, 1u);
    EXPECT_TRUE(fs::exists(folder / "out" / "results.csv"));
    EXPECT_EQ(start(0, false), "no error") << "nothing is left to do";
    EXPECT_EQ(asked, 1u);
    EXPECT_EQ(said.find("This study takes "), std::string::npos) << said;
}

TEST_F(LongStudy, IsNoneOfAFewSeconds) {
    EXPECT_EQ(start(RunSettings{}.names_after, false), "no error");
    EXPECT_EQ(asked, 0u);
    EXPECT_EQ(said.find("stimating"), std::string::npos) << said;
}

}  // namespace
