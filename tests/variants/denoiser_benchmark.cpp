#include "core/gpu/device.h"
#include "tests/variants/denoiser_scene.h"

#include <benchmark/benchmark.h>
#include <algorithm>
#include <ctime>
#include <map>

// The denoiser's passes in both forms, side by side, in the moving scene that their tests compare them in. Times are
// those of the pass graph (ms per frame, submission included); cpu_ms is the time of all processors, which other
// programs disturb less. Run with --benchmark_enable_random_interleaving=true --benchmark_repetitions=9 and compare the
// medians.

namespace {

/// Six frames, of which each follows the one before and the first the last: there the camera jumps back.
const std::vector<DenoiserInputs>& frames_of(glm::uvec2 extent) {
    static std::map<unsigned, std::vector<DenoiserInputs>> made;
    std::vector<DenoiserInputs>& frames = made[extent.x];
    for (unsigned i = 0; frames.size() < 6; ++i)
        frames.push_back(floor_and_ball(extent, DepthDirection::standard, i, (i + 5) % 6));
    return frames;
}

/// One frame, of which only the denoiser's passes are timed. Adds the time of all processors to `cpu_ms`.
std::vector<PassTime> run(DenoiserBench& bench, const DenoiserInputs& frame, const DenoiserInputs& before,
                          double& cpu_ms) {
    bench.begin_frame(frame, &before);
    const std::clock_t start = std::clock();
    amd_denoise(bench.graph, bench.gbuffer, bench.work, bench.histories, bench.denoiser);
    const std::vector<PassTime> times = bench.graph.times();
    cpu_ms += 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
    return times;
}

void denoise(benchmark::State& state, const char* form) {
    static Device device;
    const glm::uvec2 extent(state.range(0), state.range(1));
    const std::vector<DenoiserInputs>& frames = frames_of(extent);
    DenoiserBench bench(device, extent, {{"denoiser_form", form}, {"barrier_before_average", true}});
    const auto at = [&](size_t i) -> const DenoiserInputs& { return frames[i % frames.size()]; };
    double cpu_ms = 0;
    for (size_t i = 0; i < 3; ++i) run(bench, at(i + 1), at(i), cpu_ms);  // compiles the shaders, fills the histories
    std::map<std::string, double> sums;
    cpu_ms = 0;
    size_t index = 3;
    for (auto _ : state) {
        double total = 0;
        for (const PassTime& pass : run(bench, at(index + 1), at(index), cpu_ms)) {
            if (!pass.stage.starts_with("amd_sssr/")) continue;
            sums[pass.stage.substr(9)] += pass.milliseconds;
            total += pass.milliseconds;
        }
        state.SetIterationTime(total * 1e-3);
        ++index;
    }
    for (const auto& [stage, sum] : sums)
        state.counters[stage + "_ms"] = benchmark::Counter(sum, benchmark::Counter::kAvgIterations);
    state.counters["cpu_ms"] = benchmark::Counter(cpu_ms, benchmark::Counter::kAvgIterations);
    const HostImage& tiles = frames[0].tiles;
    state.counters["tiles"] = double(std::count(tiles.values.begin(), tiles.values.end(), 1.0f));
}

}  // namespace

BENCHMARK_CAPTURE(denoise, faithful, "faithful")
    ->Args({640, 384})
    ->Args({1280, 704})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(denoise, fast, "fast")
    ->Args({640, 384})
    ->Args({1280, 704})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
