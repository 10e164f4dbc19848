// Prints the time of metrics on two 1920x1080 images: `metrics_benchmark`.
#include "metrics/metric.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <random>

namespace {

/// Smooth waves, and noise on the test image: every branch of FLIP is taken.
const ImagePair& full_hd_pair() {
    static const ImagePair pair = [] {
        const glm::uvec2 extent(1920, 1080);
        HostImage reference(extent, 3), test(extent, 3);
        std::minstd_rand random(1);
        for (size_t i = 0; i < reference.values.size(); ++i) {
            reference.values[i] = 0.5f + 0.4f * std::sin(float(i % 5760) * 0.01f) * std::cos(float(i / 5760) * 0.02f);
            test.values[i] = reference.values[i] * (0.8f + 0.4f * std::generate_canonical<float, 24>(random));
        }
        return image_pair(reference, test, {.flip_exposures = FlipExposures{-4, 4, 9}});
    }();
    return pair;
}

void measure_metric(benchmark::State& state, const std::string& name) {
    const ImagePair& pair = full_hd_pair();
    const Metric& metric = metric_named(name);
    for (auto _ : state) benchmark::DoNotOptimize(measure(metric, pair));
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    for (const std::string& name : metric_names())
        benchmark::RegisterBenchmark((name + "/1920x1080").c_str(), measure_metric, name)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    benchmark::RunSpecifiedBenchmarks();
}
