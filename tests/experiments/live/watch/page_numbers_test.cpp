// The page's numbers are those of the results folder that it shows, and its verdicts those of the judge.
#include "experiments/live/watch/page_numbers.h"
#include "core/error.h"
#include "experiments/results/verdicts/judgement.h"
#include "experiments/results/verdicts/study_results.h"
#include "tests/error_message.h"
#include "tests/experiments/report/report_fixture.h"
#include "tests/experiments/report/report_study_fixture.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <algorithm>

namespace fs = std::filesystem;

namespace {

class PageNumbers : public testing::Test {
protected:
    const fs::path folder = fs::temp_directory_path() / "page_numbers";
    PageImages images;

    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }
};

WatchedPoint point(const std::string& technique, const std::string& preset) {
    return {.technique = "./technique/" + technique, .preset = preset, .label = technique + " " + preset};
}

}  // namespace

TEST_F(PageNumbers, VerdictsAreTheJudges) {
    write_study_fixture(folder);
    const StudyResults tables = read_study_results(folder);
    const WatchedPoint fixed = point("sssr", "fixed"), first = point("sssr", "first");
    const nlohmann::json page = page_numbers(folder, fixed, {first}, images);
    ASSERT_EQ(page["verdicts"].size(), 2u) << "and no reflections";
    for (const nlohmann::json& said : page["verdicts"]) {
        const PointName against = said["label"] == "no reflections" ? PointName("none", "default") : first.name();
        std::string verdict;
        const std::string why =
            error_message([&] { verdict = judge_effects(tables.effects, {}, fixed.name(), against).verdict; });
        EXPECT_EQ(said["verdict"], verdict) << said;
        EXPECT_EQ(said["why"], verdict.empty() ? why : "") << said;
        EXPECT_FALSE(verdict.empty() && said["why"] == "") << said;
    }
    EXPECT_TRUE(std::ranges::any_of(page["verdicts"], [](const auto& said) { return said["verdict"] != ""; })) << page;
    ASSERT_FALSE(page["shots"].empty());
    for (const nlohmann::json& shot : page["shots"]) {
        const auto row = std::ranges::find_if(tables.summary, [&](const MetricSummary& e) {
            return e.shot == shot["shot"] && e.point == "fixed" && e.metric == "mse" && e.mask == "reflective" &&
                   e.target == "specular" && e.represents_shot;
        });
        ASSERT_NE(row, tables.summary.end()) << shot;
        EXPECT_EQ(shot["error"]["value"], column_json(row->value));
        EXPECT_EQ(shot["error"]["high"], column_json(row->high));
    }
}

TEST_F(PageNumbers, TimesEstimatesAndCausesAreThoseOfThePoint) {
    write_study_fixture(folder);
    const StudyResults tables = read_study_results(folder);
    const WatchedPoint fixed = point("sssr", "fixed"), first = point("sssr", "first");
    const nlohmann::json times = page_times(folder, fixed, {first});
    const auto of_fixed = [](const auto& row) { return row.point == "fixed"; };
    EXPECT_EQ(times["stages"].size(), size_t(std::ranges::count_if(tables.time_summary, of_fixed)));
    EXPECT_EQ(times["estimates"].size(), size_t(std::ranges::count_if(tables.estimates, of_fixed)));
    ASSERT_FALSE(times["effects"].empty());
    EXPECT_EQ(times["effects"][0]["label"], "sssr first");
    EXPECT_GT(times["effects"][0]["ratio"], 1.5) << "it takes twice as long";
    EXPECT_TRUE(page_times(folder, point("none", ""), {})["stages"].empty()) << "no reflections take no time";
    const nlohmann::json why = page_why(folder, first, images);
    EXPECT_FALSE(why["rays"].empty());
}

TEST_F(PageNumbers, ImagesAreThereByTheirHashesAlone) {
    write_report_fixture(folder);
    const nlohmann::json page = page_numbers(folder, point("mcguire_dda", "best"), {}, images);
    EXPECT_TRUE(page["shots"].empty()) << "there is no such point";
    const nlohmann::json none = page_numbers(folder, point("none", ""), {}, images);
    ASSERT_FALSE(none["shots"].empty());
    const nlohmann::json image = none["shots"][0]["images"]["truth"]["specular"];
    EXPECT_TRUE(images.find(image["name"]));
    for (const char* name : {"", "manifest.json", "../study.json", "/etc/passwd"})
        EXPECT_FALSE(images.find(name)) << name;
}
