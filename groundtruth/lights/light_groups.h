#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// A light, or a piece of the sky, for divide_lights().
struct PlacedPower {
    std::array<float, 6> place;  ///< lights with near places shine on the same points
    double power;                ///< in any unit
};

/// Divides lights into at most `max_groups` groups of near lights. Repeatedly cuts the group of greatest power times
/// extent into halves of equal power, until no group is longer than `least_extent`. Lights without power are in no
/// group.
std::vector<std::vector<uint32_t>> divide_lights(std::span<const PlacedPower> lights, size_t max_groups,
                                                 float least_extent);
