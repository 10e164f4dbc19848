#pragma once
#include <functional>
#include <optional>
#include <string_view>

/// CPU time spent since some moment, in seconds, to detect other programs on the machine during a measurement.
struct CpuTimes {
    std::optional<double>
        machine;        ///< of all CPUs and processes, with time taken by other virtual machines; none if not reported
    double stolen = 0;  ///< part of `machine` that other virtual machines took; 0 if not reported
    double own = 0;     ///< of this process
    double wall = 0;    ///< elapsed
    unsigned cpus = 1;  ///< of the machine
};

/// Reads the times from /proc/stat, which counts in steps of 10 ms by sampling: spans below a second are inaccurate.
CpuTimes read_cpu_times();

/// Replaces read_cpu_times() in tests.
using CpuTimesReader = std::function<CpuTimes()>;

/// Busy seconds of all CPUs and their number, from the text of /proc/stat (proc(5)); none if it is another text, or all
/// zeros, as some containers have it.
struct MachineTimes {
    double busy = 0;    ///< includes `stolen`
    double stolen = 0;  ///< by other virtual machines
    unsigned cpus = 0;
};
std::optional<MachineTimes> parse_proc_stat(std::string_view text, double ticks_per_second);

/// The share of the machine's CPU time between two moments that other programs took, in [0, 1]; none if not reported.
std::optional<double> foreign_load(const CpuTimes& before, const CpuTimes& after);

/// The part of foreign_load() that other virtual machines took; 0 if not reported.
double stolen_share(const CpuTimes& before, const CpuTimes& after);

/// Above this share of foreign load times count as disturbed. An idle Linux takes below 1 %, and sampling errs by some
/// 2 % in a second on two CPUs.
inline constexpr double disturbing_load = 0.05;
