#pragma once
#include "core/gpu/pass_graph.h"

#include <string>
#include <vector>

/// Passes of known relative work, timed as every stage is timed.
struct ClockCheck {
    std::string stage_kind;  ///< "compute", "fragment", "fragment after compute"
    std::vector<double> expected{1, 10, 100};
    std::vector<double> measured_ms;  ///< shortest of several, less that of the same pass without work
    std::vector<double> ratio;        ///< measured_ms over that of the largest work, times 100
    unsigned attempts = 0;            ///< up to clock_attempts
    bool passed = false;
};

/// Says whether the clock can be trusted: work of 1 : 10 : 100 must take time in that ratio, within `clock_tolerance`.
struct ClockProof {
    std::string method;          ///< "host_fence" or "gpu_timestamp"
    double empty_submit_ms = 0;  ///< what submitting no work and waiting takes: the floor of every stage on a CPU
    std::vector<ClockCheck> checks;
    bool passed() const;
};

/// A ratio may be off by this factor either way. A stamp that misses the work, or encloses the neighbour's, is off by
/// 10 or more; on a machine three times oversubscribed 2.5 was seen.
inline constexpr double clock_tolerance = 3.0;

/// On a busy machine any measurement may be disturbed: a check that fails is repeated. A broken clock fails each time.
inline constexpr unsigned clock_attempts = 3;

/// Takes about two seconds, on a busy machine several times that.
ClockProof prove_clock(Device& device);
ClockProof prove_clock(Device& device, Clock clock);
