#pragma once
#include <string_view>

// Counts (costs.csv) of a point that draws random numbers are of one seed: another seed counts others.

/// By so much the counts of two or three seeds spread at most, relative to the least: 17 points of seven techniques in
/// `fence`, `roughness_gradient` and `room:3` at 160x90. The most was 2.2 %, of the operations of `composed_ssr` in
/// `fence`. What seed 0 saves is left out (experiments/RESULTS.md). Larger images spread less.
inline constexpr double counts_spread = 0.025;
/// The same of `idle` and `atomics`, of which there are few: the most was 51 %, of 68 to 103 idle invocations.
inline constexpr double few_counts_spread = 0.55;

constexpr double counts_spread_of(std::string_view quantity) {
    return quantity == "idle" || quantity == "atomics" ? few_counts_spread : counts_spread;
}
