#include "core/gpu/clock.h"

#include "core/gpu/device.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr unsigned repeats = 12;
constexpr double unit_ms = 0.3;
const glm::uvec2 extent(64,
                        64);  // few threads: on a machine under load, work that needs every core at once never gets it

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + long(values.size() / 2));
    return values[values.size() / 2];
}

double milliseconds_of(const std::vector<PassTime>& times, const std::string& stage) {
    const auto found = std::ranges::find(times, stage, &PassTime::stage);
    return found == times.end() ? 0.0 : found->milliseconds;
}

void add_work(PassGraph& graph, bool is_compute, int iterations, const std::string& label) {
    const Image result = graph.image("result", Format::rgba32f);
    auto pass = is_compute ? graph.compute("clock/work.comp") : graph.fragment("clock/work.frag");
    pass.write(result).set("iterations", iterations).label(label).run();
}

/// The shortest of `repeats` times of each pass, each frame running all of them. Other load only ever adds to work that
/// is always the same, so the shortest time is the one to compare.
std::vector<double> shortest_times(PassGraph& graph, const std::string& kind, const std::vector<int>& iterations) {
    const ParameterSet none;
    std::vector<double> shortest(iterations.size(), INFINITY);
    for (unsigned repeat = 0; repeat <= repeats; ++repeat) {
        graph.begin_frame({}, none, {});
        for (size_t i = 0; i < iterations.size(); ++i) {
            // Work just before: a stamp that comes out one pass late would show it.
            if (kind == "fragment after compute") add_work(graph, true, iterations.back() / 3, "before");
            add_work(graph, kind == "compute", iterations[i], "work " + std::to_string(i));
        }
        const std::vector<PassTime> times = graph.times();
        if (repeat == 0) continue;  // compiles
        for (size_t i = 0; i < iterations.size(); ++i)
            shortest[i] = std::min(shortest[i], milliseconds_of(times, "work " + std::to_string(i)));
    }
    return shortest;
}

/// How often the shaders' loops must run on this device to take `unit_ms`.
int iterations_of_unit(PassGraph& graph, const std::string& kind) {
    constexpr int tried = 20000;
    const std::vector<double> times = shortest_times(graph, kind, {0, tried});
    const double milliseconds = std::max(times[1] - times[0], 1e-3);
    return int(std::clamp(tried * unit_ms / milliseconds, 1.0, 1e6));
}

ClockCheck check(Device& device, Clock clock, const std::string& kind) {
    ClockCheck check{.stage_kind = kind};
    PassGraph graph(device, extent, clock);
    const int unit = iterations_of_unit(graph, kind);
    const std::vector<double> times = shortest_times(graph, kind, {0, unit, 10 * unit, 100 * unit});
    for (size_t i = 1; i < times.size(); ++i) check.measured_ms.push_back(std::max(times[i] - times[0], 0.0));
    for (const double ms : check.measured_ms) check.ratio.push_back(ms / check.measured_ms.back() * 100.0);
    check.passed = true;
    for (size_t i = 0; i < check.ratio.size(); ++i) {
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
        add_work(graph, true, 0, "empty");
        samples.push_back(milliseconds_of(graph.times(), "empty"));
    }
    return median(samples);
}

}  // namespace

bool ClockProof::passed() const { return std::ranges::all_of(checks, &ClockCheck::passed); }

ClockProof prove_clock(Device& device) {
    return prove_clock(device, device.info().is_cpu() ? Clock::host_fence : Clock::gpu_timestamp);
}

ClockProof prove_clock(Device& device, Clock clock) {
    ClockProof proof{.method = clock == Clock::host_fence ? "host_fence" : "gpu_timestamp",
                     .empty_submit_ms = measure_empty(device, clock),
                     .checks = {}};
    for (const char* kind : {"compute", "fragment", "fragment after compute"}) {
        ClockCheck result;
        for (unsigned attempt = 1; attempt <= clock_attempts && !result.passed; ++attempt) {
            result = check(device, clock, kind);
            result.attempts = attempt;
        }
        proof.checks.push_back(result);
    }
    return proof;
}
