#include "core/files.h"
#include "experiments/report/report.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/study/merge.h"

#include <benchmark/benchmark.h>
#include <filesystem>

// What a study costs whose cells are all there: to read its cells, to merge, and to run again. The study has 20 shots
// of 5 points in tiny images. What it says goes to stdout as well: `--benchmark_out=FILE` keeps the times apart.

namespace {

namespace fs = std::filesystem;

/// A finished study in a folder of its own.
class FinishedStudy {
public:
    FinishedStudy() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        std::string shots;
        for (const char* scene : {"mirror_pillars", "fence"})
            for (int height = 16; height < 26; ++height)
                shots += std::string(shots.empty() ? "" : ",") + R"({"scene": ")" + scene +
                         R"(", "resolution": [16, )" + std::to_string(height) + "]}";
        write_text(folder_ / "study.json",
                   R"({"shots": [)" + shots + R"(], "reference": {"samples": 16}, "images": "none", "seeds": 1,
            "techniques": [{"technique": "none"}, {"technique": "mcguire_dda", "sweep": {"dda.stride": [1, 2, 4, 8]}}],
            "timing": {"frames": 0}})");
        config_ = read_config(folder_ / "study.json");
        run();
    }
    ~FinishedStudy() { fs::remove_all(folder_); }

    void run() const { run_study(config_, settings("results")); }
    void merge() const { merge_study(config_, settings("merged"), {results()}); }
    fs::path results() const { return folder_ / "results"; }

private:
    RunSettings settings(const std::string& out) const {
        return {.out = folder_ / out,
                .device = "",
                .cache = folder_ / "cache",
                .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                .write_report = write_page};
    }

    const fs::path folder_ = fs::temp_directory_path() / "ssrlab_study_benchmark";
    Config config_;
};

void read_cells(benchmark::State& state, const FinishedStudy& study) {
    const CellStore store(study.results(), [](const std::string&) {});
    const std::vector<std::string> names = store.names();
    for ([[maybe_unused]] const auto _ : state)
        for (const std::string& name : names) benchmark::DoNotOptimize(store.load(name));
    state.SetItemsProcessed(int64_t(state.iterations() * names.size()));
}

void merge(benchmark::State& state, const FinishedStudy& study) {
    for ([[maybe_unused]] const auto _ : state) study.merge();
}

void run_again(benchmark::State& state, const FinishedStudy& study) {
    for ([[maybe_unused]] const auto _ : state) study.run();
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    const FinishedStudy study;
    benchmark::RegisterBenchmark("read_cells", read_cells, std::cref(study))->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("merge", merge, std::cref(study))->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("run_again", run_again, std::cref(study))->Unit(benchmark::kMillisecond);
    benchmark::RunSpecifiedBenchmarks();
}
