#pragma once
#include <array>

/// The seconds of a frame by its pixels: fixed + scale pixels^power. A pass takes so long for each pixel (power 1); a
/// march over the pixels of a ray visits more of them the larger the image is (power 3/2).
struct Growth {
    double fixed = 0, scale = 0, power = 1;
    double at(double pixels) const;
};

/// Through the first and the last of three sizes, the least first, with the power within [1, 3/2] that comes nearest to
/// the second. What hardly grows (an image of a size of its own) is fixed.
Growth growth_through(const std::array<double, 3>& pixels, const std::array<double, 3>& seconds);
