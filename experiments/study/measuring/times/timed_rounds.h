#pragma once
#include "core/cpu_times.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// Which rounds of a timing run, and which count. A round is one frame in which all that is timed takes turns.

/// Rounds that all timed points get, however small the budget. Their interval is their range. It covers the median as
/// often as the ranks of 15 rounds that median_interval() takes: in 99.2 % of cases with independent rounds, in 95 %
/// where each round tells half of the next.
inline constexpr unsigned least_rounds = 8;

/// Least duration (s) of rounds whose foreign load is told: /proc/stat counts by sampling.
inline constexpr double load_window = 1.0;

struct RoundLoad {
    std::optional<double> foreign;  ///< foreign_load() of the window that holds the round
    double stolen = 0;              ///< part of `foreign` that other virtual machines took

    bool is_disturbed() const { return foreign.value_or(0.0) > disturbing_load; }
};

/// Measures the foreign load of windows of rounds that last load_window together. Each round of a window has the
/// window's load.
class LoadWindow {
public:
    explicit LoadWindow(const CpuTimesReader& cpu_times)
        : cpu_times_(cpu_times), first_(cpu_times()), start_(first_), now_(first_) {}

    /// Ends a round. Assigns loads to the rounds since the last window if they took long enough.
    void end_round();
    /// Assigns a load to the last rounds, too. Their window reaches back into the previous one; without a previous one,
    /// this call waits until it is long enough.
    void tell_rest();
    const std::vector<RoundLoad>& rounds() const { return rounds_; }
    size_t quiet() const { return quiet_; }  ///< quiet rounds among those with a load
    size_t untold() const { return rounds_.size() - told_; }
    double seconds() const { return now_.wall - first_.wall; }  ///< duration up to the last round

private:
    void tell(const CpuTimes& start);

    const CpuTimesReader& cpu_times_;
    CpuTimes first_, start_, now_;
    std::optional<CpuTimes> start_before_;  ///< start of the previous window
    std::vector<RoundLoad> rounds_;
    size_t told_ = 0, quiet_ = 0;
};

/// The rounds that count, in their order: the first `wanted` quiet ones if at least least_rounds are quiet, else the
/// `wanted` least disturbed. The load alone chooses, never a measured time.
std::vector<size_t> chosen_rounds(std::span<const RoundLoad> rounds, size_t wanted);

/// Whether each point's place in the order by time is still open after these rounds. `times`: by point and round, above
/// 0, the same rounds for all.
///
/// A place is settled if, for every other point, the interval of the median ratio (median_interval()) is clearly apart
/// from 1: its distance from 1 is at least its reach from the median. A point thus stops only for a difference far
/// beyond chance, and intervals of points that go on or stop cover as they would without a look
/// (TimedRounds.LooksDoNotSpoilTheCoverage).
std::vector<bool> open_orders(const std::vector<std::vector<double>>& times);
