#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// A light, or a piece of the sky, as far as dividing lights into groups goes.
struct PlacedPower {
    std::array<float, 6> place;  ///< lights that are near each other in it shine on the same places
    double power;                ///< in any unit
};

/// Divides lights into at most `max_groups` groups of lights that are near each other: again and again the group of the
/// greatest power times extent is cut where half of its power lies on either side, until no group is longer than
/// `least_extent`. Lights without power are in no group.
std::vector<std::vector<uint32_t>> divide_lights(std::span<const PlacedPower> lights, size_t max_groups,
                                                 float least_extent);
