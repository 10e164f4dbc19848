#include "core/gpu/passes/clock.h"

#include "core/gpu/device.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr unsigned repeats = 12;
constexpr double unit_ms = 0.5;
/// One workgroup, one tile of a rasteriser: a single thread of a software rasteriser runs it. Two would do the first
/// 24 ms of a pass on one core, where the scheduler wakes them together, and the rest on two.
const glm::uvec2 extent(8, 8);

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + long(values.size() / 2));
    return values[values.size() / 2];
}

double milliseconds_of(const std::vector<PassTime>& times, const std::string& stage) {
    const auto found = std::ranges::find(times, stage, &PassTime::stage);
    return found == times.end() ? 0.0 : found->milliseconds;
}

void add_work(PassList& pass_list, bool is_compute, int iterations, const std::string& label) {
    const Image result = pass_list.image("result", Format::rgba32f);
    auto pass = is_compute ? pass_list.compute("clock/work.comp") : pass_list.fragment("clock/work.frag");
    pass.write(result).set("iterations", iterations).label(label).run();
}

/// The shortest of `repeats` times of each pass, each frame running all of them. Other load only ever adds to work that
/// is always the same, so the shortest time is the one to compare.
std::vector<double> shortest_times(PassList& pass_list, const std::string& kind, const std::vector<int>& iterations) {
    const ParameterSet none;
    std::vector<double> shortest(iterations.size(), INFINITY);
    for (unsigned repeat = 0; repeat <= repeats; ++repeat) {
        pass_list.begin_frame({}, none, {});
        for (size_t i = 0; i < iterations.size(); ++i) {
            // Work just before: a stamp that comes out one pass late would show it. It also wakes the threads of a
            // software device, which the first pass of a frame else waits for: 0.13 ms in place of 0.06, by which all
            // others seemed shorter.
            add_work(pass_list, kind != "fragment", iterations.back() / 3, "before");
            add_work(pass_list, kind == "compute", iterations[i], "work " + std::to_string(i));
        }
        const std::vector<PassTime> times = pass_list.times();
        if (repeat == 0) continue;  // compiles
        for (size_t i = 0; i < iterations.size(); ++i)
            shortest[i] = std::min(shortest[i], milliseconds_of(times, "work " + std::to_string(i)));
    }
    return shortest;
}

/// How often the shaders' loops must run on this device to take `unit_ms`.
int iterations_of_unit(PassList& pass_list, const std::string& kind) {
    constexpr int tried = 80;
    const std::vector<double> times = shortest_times(pass_list, kind, {0, tried});
    const double milliseconds = std::max(times[1] - times[0], 1e-3);
    return int(std::clamp(tried * unit_ms / milliseconds, 1.0, 1e6));
}

ClockCheck check(Device& device, Clock clock, const std::string& kind, const CpuTimesReader& cpu_times) {
    ClockCheck check{.stage_kind = kind};
    PassList pass_list(device, extent, clock);
    const int unit = iterations_of_unit(pass_list, kind);
    const CpuTimes before = cpu_times();
    const std::vector<double> times = shortest_times(pass_list, kind, {0, unit, 10 * unit, 100 * unit});
    check.foreign_load = foreign_load(before, cpu_times());
    for (size_t i = 1; i < times.size(); ++i) check.measured_ms.push_back(std::max(times[i] - times[0], 0.0));
    judge(check);
    return check;
}

/// The first attempt that passes; else the last that failed on a quiet machine; else the last.
ClockCheck repeated_check(Device& device, Clock clock, const std::string& kind, const CpuTimesReader& cpu_times) {
    ClockCheck result;
    for (unsigned attempt = 1; attempt <= clock_attempts && result.verdict != ClockVerdict::passed; ++attempt) {
        ClockCheck next = check(device, clock, kind, cpu_times);
        if (next.verdict != ClockVerdict::not_judged || result.verdict == ClockVerdict::not_judged)
            result = std::move(next);
        result.attempts = attempt;
    }
    return result;
}

/// The median time of a pass that does nothing.
double measure_empty(Device& device, Clock clock) {
    PassList pass_list(device, {1, 1}, clock);
    const ParameterSet none;
    std::vector<double> samples;
    for (unsigned repeat = 0; repeat < 31; ++repeat) {
        pass_list.begin_frame({}, none, {});
        add_work(pass_list, true, 0, "empty");
        samples.push_back(milliseconds_of(pass_list.times(), "empty"));
    }
    return median(samples);
}

}  // namespace

const char* name_of(ClockVerdict verdict) {
    return verdict == ClockVerdict::passed ? "passed" : verdict == ClockVerdict::failed ? "failed" : "not_judged";
}

void judge(ClockCheck& check) {
    const double largest = check.measured_ms.back();
    check.ratio.clear();
    bool is_in_ratio = largest > 0;
    for (size_t i = 0; i < check.measured_ms.size(); ++i) {
        check.ratio.push_back(largest > 0 ? check.measured_ms[i] / largest * check.expected.back() : 0.0);
        const double factor = check.ratio[i] / check.expected[i];
        is_in_ratio = is_in_ratio && factor > 1.0 / clock_tolerance && factor < clock_tolerance;
    }
    const bool is_busy = check.foreign_load.value_or(0.0) > disturbing_load;
    check.verdict = is_in_ratio ? ClockVerdict::passed : is_busy ? ClockVerdict::not_judged : ClockVerdict::failed;
}

ClockVerdict ClockProof::verdict() const {
    for (const ClockVerdict verdict : {ClockVerdict::failed, ClockVerdict::not_judged})
        if (std::ranges::find(checks, verdict, &ClockCheck::verdict) != checks.end()) return verdict;
    return checks.empty() ? ClockVerdict::not_judged : ClockVerdict::passed;
}

ClockProof prove_clock(Device& device, const CpuTimesReader& cpu_times) {
    return prove_clock(device, device.info().is_cpu() ? Clock::host_fence : Clock::gpu_timestamp, cpu_times);
}

ClockProof prove_clock(Device& device, Clock clock, const CpuTimesReader& cpu_times) {
    ClockProof proof{.method = clock == Clock::host_fence ? "host_fence" : "gpu_timestamp",
                     .empty_submit_ms = measure_empty(device, clock),
                     .checks = {}};
    for (const char* kind : {"compute", "fragment", "fragment after compute"})
        proof.checks.push_back(repeated_check(device, clock, kind, cpu_times));
    return proof;
}
