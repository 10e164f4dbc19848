// What a report of hundreds of shots takes: its tables are read, judged in sentences, and written as a page.
#include "experiments/report/report.h"
#include "tests/experiments/report/report_shots_fixture.h"

#include <benchmark/benchmark.h>
#include <filesystem>

namespace {

void measure_report(benchmark::State& state) {
    const auto folder = std::filesystem::temp_directory_path() / "ssrlab_report_benchmark";
    std::filesystem::remove_all(folder);
    write_shots_fixture(folder, size_t(state.range(0)));
    const bool links_images = state.range(1) != 0;
    for (auto _ : state) write_report(folder, links_images);
    state.counters["page_mb"] = double(std::filesystem::file_size(folder / "report.html")) * 1e-6;
    std::filesystem::remove_all(folder);
}

}  // namespace

BENCHMARK(measure_report)
    ->Name("report")
    ->ArgNames({"shots", "linked"})
    ->ArgsProduct({{50, 100, 200, 400}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_MAIN();
