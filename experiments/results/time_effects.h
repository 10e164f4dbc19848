#pragma once
#include "experiments/results/cell.h"
#include "experiments/study/config/comparisons.h"

#include <span>

/// What a point's time is of another's: of the total, and of each stage that both have.
struct TimeEffectRow {
    std::string shot, variant, point;
    std::string against, against_variant, against_point;  ///< as in EffectRow
    std::string stage, clock;
    size_t rounds = 0;  ///< frames in which both were timed
    double ratio = 1;   ///< median over the rounds of time / time of the other
    double low = 1, high = 1;

    static constexpr auto columns() {
        return std::tuple(Column{"shot", &TimeEffectRow::shot}, Column{"variant", &TimeEffectRow::variant},
                          Column{"point", &TimeEffectRow::point}, Column{"against", &TimeEffectRow::against},
                          Column{"against_variant", &TimeEffectRow::against_variant},
                          Column{"against_point", &TimeEffectRow::against_point},
                          Column{"stage", &TimeEffectRow::stage}, Column{"clock", &TimeEffectRow::clock},
                          Column{"rounds", &TimeEffectRow::rounds}, Column{"ratio", &TimeEffectRow::ratio},
                          Column{"low", &TimeEffectRow::low}, Column{"high", &TimeEffectRow::high});
    }
};

/// The median of paired values and its 95 % interval from order statistics: the ranks n / 2 -+ 1.96 sqrt(f n) / 2 of a
/// binomial distribution with p = 1/2, whose variance is f times that of independent signs, since what slows a machine
/// down lasts for several rounds. f = 1 + 2 sum rho_k over the autocorrelations of the signs up to the first that is
/// not above 0 (the initial positive sequence of Geyer 1992, "Practical Markov Chain Monte Carlo"), at least 2: of 15
/// rounds it cannot be told better. The range where there are too few.
///
/// Coverage of the median over 400 rounds by windows of 15, 30 and 60 of them, all pairs of five points on lavapipe
/// while 18 processes shared two cores: 98, 96 and 94 %; with f = 1 it is 93, 89 and 88 %, and a bootstrap over rounds
/// of the ratio of medians covers 55 to 99 % of pairs, mostly with wider intervals.
struct PairedMedian {
    double median = 0, low = 0, high = 0;
};
PairedMedian paired_median(std::span<const double> in_order_of_time);

/// All comparisons_of() `variants` by times.csv's rows. The points took turns in each frame, so that the ratio of one
/// frame's times is free of what the frame costs and of slow drifts.
std::vector<TimeEffectRow> time_effects(std::span<const TimeRow> times, const std::vector<VariantConfig>& variants);
