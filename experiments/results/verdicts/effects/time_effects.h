#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/effects/effects.h"
#include "metrics/statistics/median_interval.h"

#include <nlohmann/json.hpp>
#include <span>

/// A point's time relative to another point's: the total, and each stage that both have.
struct TimeEffectRow {
    std::string shot, technique, point;
    std::string against, against_technique, against_point;  ///< as in EffectRow
    std::string stage, clock;
    size_t rounds = 0;         ///< frames in which both were timed
    double ratio = 1;          ///< median over the rounds of time / other point's time
    double low = 1, high = 1;  ///< 95 % interval over the rounds
    std::optional<double> p;   ///< of "both take the same time", see set_time_verdicts()
    std::optional<double> p_holm, low_holm, high_holm;
    std::string verdict;  ///< as EffectRow's; empty without a p

    COLUMNS(TimeEffectRow, shot, technique, point, against, against_technique, against_point, stage, clock, rounds,
            ratio, low, high, p, p_holm, low_holm, high_holm, verdict)
};

/// All comparisons_of() `compared`, by rows of times.csv. Points take turns in each frame, so the ratio of one frame's
/// times is free of the frame's cost and of slow drifts (median_interval() of the ratios).
std::vector<TimeEffectRow> time_effects(std::span<const TimeRow> times, const std::vector<ComparedPoint>& compared);

/// A ratio of two times with all its uncertainty: its 95 % interval over rounds, and the difference of two copies of
/// one point (aa_floor()), which more rounds do not reduce. Both are added in quadrature. The sum is Student's with as
/// many degrees of freedom as there were pairs of copies.
struct TimeRatio {
    double log_ratio = 0;   ///< natural logarithm
    double half_width = 0;  ///< of the logarithm's 95 % interval (normal)
    size_t degrees = 1;     ///< pairs of copies; 0 counts as 1

    double p_value() const;                                  ///< two-sided, of "the ratio is 1"
    std::pair<double, double> interval(double level) const;  ///< of the ratio, with confidence 1 - level
};

/// `rounds`: the interval of the ratio over the rounds; above 0.
TimeRatio time_ratio(const Estimate& rounds, double aa_floor, size_t aa_pairs);

/// Decides `verdict` (less or more time) of all effects on the total, in shots where points were timed twice. The
/// effects are a family with p-values adjusted together (holm_adjusted()). Single stages have no verdict, as copies are
/// compared by their totals. `manifest` has the noise of times (aa_floor()).
void set_time_verdicts(std::span<TimeEffectRow> effects, const nlohmann::json& manifest);
