#pragma once
#include "core/cpu_times.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// Which rounds of a timing are taken, and which count. A round is one frame, in which all that is timed takes turns.

/// Rounds that all timed points get, however small the budget. Their interval is their range, which holds the median as
/// often as the ranks that median_interval() takes of 15: 99.2 % of independent rounds, 95 % where each tells half of
/// the next.
inline constexpr unsigned least_rounds = 8;

/// /proc/stat counts by sampling, so foreign load is told of rounds that last at least this long together (s).
inline constexpr double load_window = 1.0;

struct RoundLoad {
    std::optional<double> foreign;  ///< foreign_load() of the window that holds the round
    double stolen = 0;              ///< of it, what other virtual machines took

    bool is_disturbed() const { return foreign.value_or(0.0) > disturbing_load; }
};

/// Foreign load of rounds that last load_window together, each of which then has it.
class LoadWindow {
public:
    explicit LoadWindow(const CpuTimesReader& cpu_times)
        : cpu_times_(cpu_times), first_(cpu_times()), start_(first_), now_(first_) {}

    /// A round has ended. Tells the load of the rounds since the last time, if they took long enough.
    void end_round();
    /// Tells that of the last rounds, too: their window reaches back into the one before, or, if there was none, is
    /// waited for.
    void tell_rest();
    const std::vector<RoundLoad>& rounds() const { return rounds_; }
    size_t quiet() const { return quiet_; }  ///< of those whose load is told
    size_t untold() const { return rounds_.size() - told_; }
    double seconds() const { return now_.wall - first_.wall; }  ///< up to the last round

private:
    void tell(const CpuTimes& start);

    const CpuTimesReader& cpu_times_;
    CpuTimes first_, start_, now_;
    std::optional<CpuTimes> start_before_;  ///< of the window before
    std::vector<RoundLoad> rounds_;
    size_t told_ = 0, quiet_ = 0;
};

/// Of the rounds, those that count: the first `wanted` quiet ones if at least least_rounds of them are quiet, else the
/// `wanted` least disturbed; in their order. It is the load that chooses, never a time that was measured.
std::vector<size_t> chosen_rounds(std::span<const RoundLoad> rounds, size_t wanted);

/// By point: whether its place among the others by time is open after these rounds; `times`: by point and round, above
/// 0, the same rounds for all. It is settled where the interval of the median ratio
/// (metrics/statistics/median_interval.h) to every other point lies apart from 1 by as much again as it reaches from
/// the median. A point that stops here thus stops for a difference far beyond what chance gives, so that intervals of
/// those that go on, and of those that do not, cover as they would without a look
/// (TimedRounds.LooksDoNotSpoilTheCoverage).
std::vector<bool> open_orders(const std::vector<std::vector<double>>& times);
