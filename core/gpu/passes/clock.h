#pragma once
#include "core/cpu_times.h"
#include "core/gpu/passes/pass_list.h"

#include <optional>
#include <string>
#include <vector>

/// What a check says of a clock. Times on a busy machine prove nothing for or against the clock.
enum class ClockVerdict { passed, failed, not_judged };
/// As in manifest.json: "passed", "failed", "not_judged".
const char* name_of(ClockVerdict verdict);

/// Passes of known relative work, timed as every stage is timed.
struct ClockCheck {
    std::string stage_kind;  ///< "compute", "fragment", "fragment after compute"
    std::vector<double> expected{1, 10, 100};
    std::vector<double> measured_ms;     ///< shortest of several, less that of the same pass without work
    std::vector<double> ratio;           ///< measured_ms over that of the largest work, times 100
    std::optional<double> foreign_load;  ///< during the check, see foreign_load(); none if not reported
    unsigned attempts = 0;               ///< up to clock_attempts
    ClockVerdict verdict = ClockVerdict::not_judged;
};

/// Says whether the clock can be trusted: work of 1 : 10 : 100 must take time in that ratio, within `clock_tolerance`.
struct ClockProof {
    std::string method;          ///< "host_fence" or "gpu_timestamp"
    double empty_submit_ms = 0;  ///< what submitting no work and waiting takes: the floor of every stage on a CPU
    std::vector<ClockCheck> checks;
    ClockVerdict verdict() const;  ///< failed if a check failed, else not_judged if a check is not judged
};

/// A ratio may be off by this factor either way. A stamp that misses the work, or encloses the neighbour's, is off by
/// 10 or more.
inline constexpr double clock_tolerance = 1.2;

/// A check that does not pass is repeated: the shortest of some times may be disturbed by chance. A broken clock never
/// passes.
inline constexpr unsigned clock_attempts = 3;

/// Judges one attempt. It passes if the ratios of its times are those of the work. Else the clock fails, unless other
/// programs took more than disturbing_load of the machine. Sets `ratio` and `verdict` from `measured_ms`, `expected`
/// and `foreign_load`.
void judge(ClockCheck& check);

/// Checks the clock that suits the device, or `clock`. Takes about 5 s, and up to 15 s if it has to repeat.
ClockProof prove_clock(Device& device, const CpuTimesReader& cpu_times = read_cpu_times);
ClockProof prove_clock(Device& device, Clock clock, const CpuTimesReader& cpu_times = read_cpu_times);
