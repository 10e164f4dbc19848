#pragma once
#include "core/files.h"
#include "experiments/report/report.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/merge.h"

#include <gtest/gtest.h>
#include <filesystem>

namespace fs = std::filesystem;

/// A temporary folder with a cache, in which small studies run.
struct StudyTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / "study_test";

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
        // Tests run side by side, and beside studies of the user: no time of theirs is looked at.
        setenv("SSRLAB_TIMING_LOCK", (folder / "timing.lock").c_str(), 1);
    }
    void TearDown() override { fs::remove_all(folder); }

    Config config(const std::string& scenes, const std::string& more = "") {
        write_text(folder / "study.json",
                   R"({"shots": [{"scene": )" + scenes +
                       R"(, "resolution": [96, 54]}], "reference": {"samples": 64},
            "techniques": [{"technique": "none"}, {"technique": "mcguire_dda"}], "timing": {"frames": 0}, "seeds": 2)" +
                       (more.find("\"metrics\"") == more.npos ? R"(, "metrics": ["mse", "relmse"])" : "") + more + "}");
        return read_config(folder / "study.json");
    }
    fs::path run(const Config& study, const std::string& out, bool keep_all = false) {
        run_study(study, {.out = folder / out,
                          .device = "",
                          .cache = folder / "cache",
                          .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                          .keep_all = keep_all,
                          .write_report = write_page});
        return folder / out;
    }
};
