// A study whose techniques read a filtered lit colour.
#include "core/json.h"
#include "experiments/results/cells/cell.h"
#include "tests/experiments/study/study_fixture.h"

namespace {

nlohmann::json shot_of(const fs::path& out) { return read_json(out / "manifest.json").at("shots").at(0); }

}  // namespace

/// Techniques read other light, and what they are compared with is the same.
TEST_F(StudyTest, FiltersWhatTechniquesReadAndNothingElse) {
    const auto run_with = [&](const std::string& out, const char* filter) {
        write_text(folder / "study.json",
                   std::string(R"({"shots": [{"scene": "room:3", "resolution": [48, 27]}], "seeds": 1,
"techniques": [{"technique": "none"}, {"technique": "mcguire_dda"}], "timing": {"frames": 0}, "metrics": ["mse"], "masks": ["all"],
"reference": {"samples": 16, "lit_noise": false, "lit_filter": )") +
                       filter + "}}");
        return run(read_config(folder / "study.json"), out);
    };
    const fs::path raw = run_with("raw", "false"), filtered = run_with("filtered", "true");
    EXPECT_EQ(shot_of(raw).at("lit"), "path_traced");
    EXPECT_EQ(shot_of(filtered).at("lit"), "filtered");
    EXPECT_EQ(shot_of(raw).at("reference").at("hash"), shot_of(filtered).at("reference").at("hash"));
    const std::vector<ResultRow> a = read_rows<ResultRow>(raw / "results.csv"),
                                 b = read_rows<ResultRow>(filtered / "results.csv");
    ASSERT_EQ(a.size(), b.size());
    bool is_changed = false;
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i].technique == "none") {
            EXPECT_EQ(a[i].value, b[i].value) << a[i].target;
        }
        is_changed |= a[i].technique == "mcguire_dda" && a[i].value != b[i].value;
    }
    EXPECT_TRUE(is_changed);
}
