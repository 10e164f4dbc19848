#pragma once
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

/// The prediction of the median edge detector (LOCO-I, Weinberger et al. 2000) for value i of a plane with `width`
/// values per row: from the values to the left, above, and above the left. Sums are modulo the range of the integers.
template <class Integer>
Integer median_edge(const std::vector<Integer>& plane, size_t width, size_t i) {
    const bool has_left = i % width != 0, has_above = i >= width;
    if (!has_left || !has_above) return has_left ? plane[i - 1] : has_above ? plane[i - width] : Integer(0);
    const Integer left = plane[i - 1], above = plane[i - width], corner = plane[i - width - 1];
    const auto [low, high] = std::minmax(left, above);
    if (corner >= high) return low;
    if (corner <= low) return high;
    using Modular = std::make_unsigned_t<Integer>;
    return Integer(Modular(Modular(left) + Modular(above) - Modular(corner)));
}
