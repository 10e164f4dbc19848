#include "core/files.h"
#include "core/json.h"
#include "experiments/report/report.h"
#include "experiments/report/report_data.h"
#include "experiments/results/verdicts/study_points.h"
#include "experiments/results/verdicts/study_results.h"
#include "tests/experiments/report/report_study_fixture.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace {

struct StudyReport : testing::Test {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "study_report_test";
    void SetUp() override { write_study_fixture(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
};

}  // namespace

TEST_F(StudyReport, ReadsEffectsAsTheyWereWritten) {
    const StudyResults tables = read_study_results(folder, Runs::left_out);
    write_text(folder / "before.csv", read_text(folder / "effects.csv"));
    ASSERT_FALSE(tables.effects.empty());
    write_rows(folder / "effects.csv", tables.effects);
    EXPECT_EQ(read_text(folder / "effects.csv"), read_text(folder / "before.csv"));
}

TEST_F(StudyReport, TellsSingleChangesFromPresets) {
    const PointSet changes = single_changes(read_json(folder / "manifest.json"));
    EXPECT_EQ(changes, (PointSet{{"sssr", "first float_histories=true"},
                                 {"sssr", "first race=true"},
                                 {"sssr", "first round_up_tiles=true"}}));
    EXPECT_TRUE(single_changes(nlohmann::json::object()).empty());
}

TEST_F(StudyReport, KnowsTheDefaultsOfRegisteredTechniques) {
    const nlohmann::json manifest = {
        {"techniques",
         {{{"technique", "amd_sssr"}, {"point", "slides"}, {"parameters", {{"hierarchy.march", "slides"}}}},
          {{"technique", "of another build"}, {"point", "default"}, {"parameters", nlohmann::json::object()}}}}};
    const nlohmann::json defaults = parameter_defaults(manifest);
    ASSERT_EQ(defaults.size(), 1u);
    EXPECT_EQ(defaults["amd_sssr"]["denoiser_form"], "by_device");
    EXPECT_EQ(defaults["amd_sssr"]["hierarchy.march"], "sdk");
    EXPECT_TRUE(parameter_defaults(nlohmann::json::object()).empty());
}

TEST_F(StudyReport, LetsTheRowsOverFramesSpeakForAShot) {
    const StudyResults tables = read_study_results(folder, Runs::left_out);
    size_t over_frames = 0, of_last = 0;
    for (const MetricSummary& e : tables.summary) {
        if (!e.represents_shot || e.metric != "relmse" || e.mask != "reflective") continue;
        const bool has_frames = e.shot == study_moving_shot || e.shot == study_step_shot;
        EXPECT_EQ(e.frame, has_frames ? "" : "0") << e.shot;
        ++(has_frames ? over_frames : of_last);
    }
    EXPECT_EQ(over_frames, 2u * 7u);
    EXPECT_EQ(of_last, 5u * 7u);
}

TEST_F(StudyReport, CarriesEachFrameOfPresetsAlone) {
    const StudyResults tables = read_study_results(folder, Runs::left_out);
    const nlohmann::json data = report_data(tables, {}, single_changes(tables.manifest));
    EXPECT_EQ(data["effects"]["count"], std::ranges::count_if(tables.effects, [](const EffectRow& e) {
                  return e.technique == e.against_technique;
              }));
    EXPECT_EQ(data["splits"]["count"], 7u * 5u);
    const nlohmann::json& table = data["frames"];
    const auto text = [&](size_t row, const char* column) {
        const nlohmann::json& values = table["columns"].at(column);  // equal values are one of them
        return data["texts"][(values.is_array() ? values[row] : values).get<size_t>()].get<std::string>();
    };
    size_t frames = 0;
    for (size_t row = 0; row < table["count"]; ++row) {
        const std::string point = text(row, "point");
        EXPECT_EQ(point.find('='), std::string::npos) << point;
        if (text(row, "mask") == "reflective") ++frames;
    }
    EXPECT_EQ(frames, 4u * (4u + 16u));  // none and three presets, in all frames of both shots that have several
}

TEST_F(StudyReport, EscapesWhatParametersMean) {
    write_report(folder);
    const std::string page = read_text(folder / "report.html");
    EXPECT_EQ(page.find("<b>32</b>"), std::string::npos);
    EXPECT_NE(page.find("\\u003cb>32\\u003c/b> bits"), std::string::npos);
}

TEST_F(StudyReport, ShowsReadersWithoutScriptsPresetsAlone) {
    write_report(folder);
    const std::string page = read_text(folder / "report.html");
    const std::string part = page.substr(page.find("<noscript>"), page.find("</noscript>") - page.find("<noscript>"));
    EXPECT_NE(part.find("<td>fixed"), std::string::npos);
    for (const std::string key : {"\"in_these_scenes\":\"", "\"in_scenes_like_these\":\""}) {
        const size_t at = page.find(key);
        ASSERT_NE(at, std::string::npos) << key;
        const std::string begins = page.substr(at + key.size(), 20);
        EXPECT_NE(part.find("<p>" + begins), std::string::npos) << "both statements: " << begins;
    }
    EXPECT_EQ(part.find("float_histories=true", part.find("<table>")), std::string::npos) << "sentences may name it";
    size_t rows = 0;
    for (size_t at = 0; (at = part.find("<tr><td>", at)) != std::string::npos; ++at) ++rows;
    EXPECT_EQ(rows, 7u * 4u);  // of the physical error: it has no perceptual one
}
