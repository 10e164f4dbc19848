// Prints the time of metrics on two 1920x1080 images, and of their scores with and without the intervals that halves of
// the reference give: `metrics_benchmark`.
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/score.h"

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

/// `has_halves`: against a noisy reference, so that the score has the interval of its noise.
void measure_score(benchmark::State& state, const std::string& name, bool has_halves) {
    const ImagePair& pair = full_hd_pair();
    std::optional<ReferenceHalves> halves;
    if (has_halves) {
        std::minstd_rand random(2);
        halves = ReferenceHalves{
            .a = pair.reference, .b = pair.reference, .variance = {}, .guide = pair.reference, .samples = 64};
        halves->variance = HostImage(pair.reference.extent, 3, 1e-4f);
        for (size_t i = 0; i < pair.reference.values.size(); ++i) {
            const float noise = 0.02f * (std::generate_canonical<float, 24>(random) - 0.5f);
            halves->a.values[i] += noise, halves->b.values[i] -= noise;
        }
    }
    const MetricReference reference =
        metric_reference(pair.reference, halves, {name}, {.flip_exposures = FlipExposures{-4, 4, 9}});
    const std::vector<Mask> masks = {full_mask(pair.reference.extent)};
    for (auto _ : state) benchmark::DoNotOptimize(score(reference, pair.test, masks));
}

void measure_cvvdp_still(benchmark::State& state, const std::string& display) {
    const ImagePair& pair = full_hd_pair();
    const Viewing viewing{.display = display_named(display)};
    CvvdpStills stills(pair.reference.extent, viewing);
    for (auto _ : state) benchmark::DoNotOptimize(stills.score(pair.reference, pair.test));
}

/// One frame more, when the window of the filters is full.
void measure_cvvdp_frame(benchmark::State& state, double frames_per_second) {
    const ImagePair& pair = full_hd_pair();
    const Viewing viewing{.display = display_named("standard_hdr_linear")};
    CvvdpVideo video(pair.reference.extent, viewing, frames_per_second, TemporalPadding::warm_up);
    for (unsigned frame = 0; frame + 1 < video.window(); ++frame) video.add(pair.reference, pair.test);
    for (auto _ : state) video.add(pair.reference, pair.test);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    for (const std::string& name : metric_names())
        benchmark::RegisterBenchmark((name + "/1920x1080").c_str(), measure_metric, name)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    for (const std::string name : {"mse", "mae", "flip", "hdr_flip", "ssim"})
        for (const bool has_halves : {false, true})
            benchmark::RegisterBenchmark(("score/" + name + (has_halves ? "/with_interval" : "")).c_str(),
                                         measure_score, name, has_halves)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
    for (const std::string display : {"standard_hdr_linear", "standard_4k"})
        benchmark::RegisterBenchmark(("cvvdp_0_5_6/still/" + display).c_str(), measure_cvvdp_still, display)
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime();
    for (const int rate : {30, 60})
        benchmark::RegisterBenchmark(("cvvdp_0_5_6/frame/" + std::to_string(rate)).c_str(), measure_cvvdp_frame, rate)
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime();
    benchmark::RunSpecifiedBenchmarks();
}
