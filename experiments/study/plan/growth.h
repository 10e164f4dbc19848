#pragma once
#include <array>

/// Time (s) of a frame by its number of pixels: fixed + scale pixels^power. A pass takes a constant time for each pixel
/// (power 1). A march over a ray's pixels visits more of them in larger images (power 3/2).
struct Growth {
    double fixed = 0, scale = 0, power = 1;
    double at(double pixels) const;
};

/// The growth through the first and last of three sizes, in ascending order, with the power in [1, 3/2] that comes
/// nearest to the second. A time that hardly grows (an image of fixed size) is `fixed`.
Growth growth_through(const std::array<double, 3>& pixels, const std::array<double, 3>& seconds);
