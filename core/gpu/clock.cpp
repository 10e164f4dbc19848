#include "core/gpu/clock.h"

#include "core/gpu/device.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr unsigned repeats = 7;
constexpr int iterations_of_unit = 30;  // of the shaders' loops, per pixel
const glm::uvec2 extent(192, 192);

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + long(values.size() / 2));
    return values[values.size() / 2];
}

double milliseconds_of(const std::vector<PassTime>& times, const std::string& stage) {
    const auto found = std::ranges::find(times, stage, &PassTime::stage);
    return found == times.end() ? 0.0 : found->milliseconds;
}

void add_work(PassGraph& graph, bool is_compute, int units, const std::string& label) {
    const Image result = graph.image("result", Format::rgba32f);
    auto pass = is_compute ? graph.compute("clock/work.comp") : graph.fragment("clock/work.frag");
    pass.write(result).set("iterations", units * iterations_of_unit).label(label).run();
}

ClockCheck check(Device& device, Clock clock, const std::string& kind, double empty_ms) {
    ClockCheck check{.stage_kind = kind};
    PassGraph graph(device, extent, clock);
    const ParameterSet none;
    std::vector<std::vector<double>> samples(3);
    for (unsigned repeat = 0; repeat <= repeats; ++repeat) {
        graph.begin_frame({}, none, {});
        for (size_t i = 0; i < 3; ++i) {
            // A heavy dispatch just before: a stamp that comes out one pass late would show it.
            if (kind == "fragment after compute") add_work(graph, true, 30, "before");
            add_work(graph, kind == "compute", int(check.expected[i]), "work " + std::to_string(i));
        }
        const std::vector<PassTime> times = graph.times();
        if (repeat == 0) continue;  // compiles
        for (size_t i = 0; i < 3; ++i) samples[i].push_back(milliseconds_of(times, "work " + std::to_string(i)));
    }
    for (const auto& s : samples) check.measured_ms.push_back(std::max(median(s) - (clock == Clock::host_fence ? empty_ms : 0.0), 0.0));
    for (const double ms : check.measured_ms) check.ratio.push_back(ms / check.measured_ms.back() * 100.0);
    check.passed = true;
    for (size_t i = 0; i < 3; ++i) {
        const double factor = check.ratio[i] / check.expected[i];
        check.passed = check.passed && factor > 1.0 / clock_tolerance && factor < clock_tolerance;
    }
    return check;
}

/// The median time of a pass that does nothing.
double measure_empty(Device& device, Clock clock) {
    PassGraph graph(device, {1, 1}, clock);
    const ParameterSet none;
    std::vector<double> samples;
    for (unsigned repeat = 0; repeat < 31; ++repeat) {
        graph.begin_frame({}, none, {});
        const Image result = graph.image("result", Format::rgba32f);
        graph.compute("clock/work.comp").write(result).set("iterations", 0).label("empty").run();
        samples.push_back(milliseconds_of(graph.times(), "empty"));
    }
    return median(samples);
}

}  // namespace

bool ClockProof::passed() const { return std::ranges::all_of(checks, &ClockCheck::passed); }

ClockProof prove_clock(Device& device) { return prove_clock(device, device.info().is_cpu() ? Clock::host_fence : Clock::gpu_timestamp); }

ClockProof prove_clock(Device& device, Clock clock) {
    ClockProof proof{.method = clock == Clock::host_fence ? "host_fence" : "gpu_timestamp", .empty_submit_ms = measure_empty(device, clock), .checks = {}};
    for (const char* kind : {"compute", "fragment", "fragment after compute"}) proof.checks.push_back(check(device, clock, kind, proof.empty_submit_ms));
    return proof;
}
