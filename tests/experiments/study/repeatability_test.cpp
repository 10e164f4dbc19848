// Points whose results differ from run to run, from the technique to the report.
#include "core/json.h"
#include "experiments/report/report_warnings.h"
#include "tests/experiments/study/study_fixture.h"
#include "variants/registry.h"

namespace {

std::string reason(const nlohmann::json& parameters) {
    return make_technique("amd_sssr", parameters)->not_repeatable();
}

}  // namespace

TEST(Repeatability, IsWhatTheOrderOfThreadsCannotChange) {
    EXPECT_NE(reason({{"hierarchy.min_traversal_occupancy", 1}}).find("hierarchy.min_traversal_occupancy"),
              std::string::npos);
    const nlohmann::json faithful = {{"hierarchy.min_traversal_occupancy", 0}, {"denoiser_form", "faithful"}};
    EXPECT_NE(reason(faithful).find("barrier_before_average"), std::string::npos);
    EXPECT_EQ(reason(faithful).find("hierarchy.min_traversal_occupancy"), std::string::npos);
    nlohmann::json both = faithful;
    both["hierarchy.min_traversal_occupancy"] = 4;
    EXPECT_NE(reason(both).find("barrier_before_average"), std::string::npos);
    EXPECT_NE(reason(both).find("hierarchy.min_traversal_occupancy"), std::string::npos);

    EXPECT_EQ(reason({{"hierarchy.min_traversal_occupancy", 0}}), "") << "the fast form shares no moments";
    nlohmann::json fixed = faithful, raw = faithful;
    fixed["barrier_before_average"] = true;
    raw["denoise"] = false;
    EXPECT_EQ(reason(fixed), "");
    EXPECT_EQ(reason(raw), "");
    EXPECT_EQ(make_technique("mcguire_dda")->not_repeatable(), "");
}

TEST_F(StudyTest, SaysWhichPointsDifferFromRunToRun) {
    write_text(folder / "study.json", R"({"shots": [{"scene": "mirror_pillars", "resolution": [64, 36]}],
        "reference": {"samples": 16}, "metrics": "mse", "targets": "specular", "masks": "reflective", "seeds": 2, "timing": {"frames": 0},
        "techniques": [{"technique": "mcguire_dda", "baseline": true},
                     {"technique": "amd_sssr", "preset": "sdk_1_5", "parameters": {"denoise": false}},
                     {"technique": "amd_sssr", "preset": "corrected", "parameters": {"denoise": false}}]})");
    const fs::path out = run(read_config(folder / "study.json"), "a");
    const nlohmann::json manifest = read_json(out / "manifest.json");
    ASSERT_EQ(manifest["techniques"].size(), 3u);
    EXPECT_TRUE(manifest["techniques"][1].contains("not_repeatable"));
    for (const size_t i : {0, 2}) EXPECT_FALSE(manifest["techniques"][i].contains("not_repeatable"));
    const std::string point = manifest["techniques"][1]["point"];

    const std::vector<EffectRow> effects = read_rows<EffectRow>(out / "effects.csv");
    ASSERT_EQ(effects.size(), 2u * 3u) << "on the squared error and its parts";
    for (const EffectRow& e : effects) {
        if (e.metric != "mse") continue;
        EXPECT_TRUE(e.ratio);
        EXPECT_EQ(e.p.has_value(), e.point != point);
    }
    size_t warnings = 0;
    for (const std::string& warning : report_warnings(manifest, {}, {}))
        if (warning.find("from run to run") != std::string::npos) {
            EXPECT_TRUE(warning.starts_with("amd_sssr (" + point + "): ")) << warning;
            EXPECT_NE(warning.find("hierarchy.min_traversal_occupancy"), std::string::npos) << warning;
            ++warnings;
        }
    EXPECT_EQ(warnings, 1u);

    // The same feature is left out by two: each has its own entry.
    size_t alpha_tests = 0;
    for (const auto& part : manifest["shots"][0]["left_out"]) {
        const std::string what = part["what"];
        if (what.find("alpha tests") == std::string::npos) continue;
        EXPECT_TRUE(what == "path tracer: alpha tests" || what == "rasteriser: alpha tests") << what;
        ++alpha_tests;
    }
    EXPECT_EQ(alpha_tests, 2u);
}
