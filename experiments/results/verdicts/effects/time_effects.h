#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/effects/effects.h"
#include "metrics/statistics/median_interval.h"

#include <nlohmann/json.hpp>
#include <span>

/// What a point's time is of another's: of the total, and of each stage that both have.
struct TimeEffectRow {
    std::string shot, technique, point;
    std::string against, against_technique, against_point;  ///< as in EffectRow
    std::string stage, clock;
    size_t rounds = 0;         ///< frames in which both were timed
    double ratio = 1;          ///< median over the rounds of time / time of the other
    double low = 1, high = 1;  ///< 95 % interval over the rounds
    std::optional<double> p;   ///< of "both take the same time", see set_time_verdicts()
    std::optional<double> p_holm, low_holm, high_holm;
    std::string verdict;  ///< as EffectRow's; empty without a p

    COLUMNS(TimeEffectRow, shot, technique, point, against, against_technique, against_point, stage, clock, rounds,
            ratio, low, high, p, p_holm, low_holm, high_holm, verdict)
};

/// All comparisons_of() `compared` by times.csv's rows. The points took turns in each frame, so that the ratio of one
/// frame's times is free of what the frame costs and of slow drifts (median_interval() of the ratios).
std::vector<TimeEffectRow> time_effects(std::span<const TimeRow> times, const std::vector<ComparedPoint>& compared);

/// A ratio of two times with all that chance has a part in: its 95 % interval over the rounds, and what two copies of
/// one point differ by (aa_floor()), which no number of rounds takes away. Both are added in quadrature, and the sum is
/// Student's with as many degrees of freedom as there were pairs of copies.
struct TimeRatio {
    double log_ratio = 0;   ///< natural logarithm
    double half_width = 0;  ///< of 95 % of a normal distribution, of the logarithm
    size_t degrees = 1;     ///< pairs of copies; 0 counts as 1

    double p_value() const;                                  ///< two-sided, of "the ratio is 1"
    std::pair<double, double> interval(double level) const;  ///< of the ratio, at 1 - level
};

/// `rounds`: the interval of the ratio over the rounds; above 0.
TimeRatio time_ratio(const Estimate& rounds, double aa_floor, size_t aa_pairs);

/// Decides `verdict` of all effects on the total in shots where points were timed twice: of less or more time. They are
/// a family, whose p-values are adjusted together (holm_adjusted()). Stages by themselves have none: copies are
/// compared by their totals. `manifest` knows the noise of times (aa_floor()).
void set_time_verdicts(std::span<TimeEffectRow> effects, const nlohmann::json& manifest);
