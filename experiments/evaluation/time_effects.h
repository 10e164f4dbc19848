#pragma once
#include "experiments/config/comparisons.h"
#include "experiments/measuring/cell.h"

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

/// All comparisons_of() `variants` by times.csv's rows. The points took turns in each frame, so that the ratio of one
/// frame's times is free of what the frame costs and of slow drifts (median_interval() of the ratios).
std::vector<TimeEffectRow> time_effects(std::span<const TimeRow> times, const std::vector<VariantConfig>& variants);
