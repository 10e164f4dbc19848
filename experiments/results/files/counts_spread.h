#pragma once
#include <string_view>

// Counts (costs.csv) of a point that draws random numbers are of one seed; another seed gives other counts.

/// Largest spread of counts over two or three seeds, relative to the least count. Measured with 17 points of seven
/// techniques in `fence`, `roughness_gradient` and `room:3` at 160x90: at most 2.2 %, for operations of `composed_ssr`
/// in `fence`. The savings of seed 0 are left out: seed 0 does not move the texture of noise. Larger images spread
/// less.
inline constexpr double counts_spread = 0.025;
/// Largest spread of `idle` and `atomics`, which count few: at most 51 %, for 68 to 103 idle invocations.
inline constexpr double few_counts_spread = 0.55;

constexpr double counts_spread_of(std::string_view quantity) {
    return quantity == "idle" || quantity == "atomics" ? few_counts_spread : counts_spread;
}
