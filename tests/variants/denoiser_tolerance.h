#pragma once
#include "core/host_image.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>

// How near the denoiser's outputs must come to those of the original, or its forms to each other.

/// One unit in the last place of a half of the size of `value`.
inline double half_ulp(double value) {
    return std::ldexp(1.0, std::max(std::ilogb(std::max(std::abs(value), 1e-9)), -14) - 10);
}

/// Both sides compute in float32, to about 1e-6 of the value, and lavapipe then truncates to a half: they differ by one
/// half at most, where a half lies in between.
inline double one_half(double value) { return 1.001 * half_ulp(value); }

/// History is interpolated at uv from a chain of float32 matrices: 1e-7 of the extent, 1e-4 of a pixel, between colours
/// that differ by about 1.
inline double interpolated(double value) { return one_half(value) + 1e-4; }

/// The relative change of luminance is a difference of nearly equal numbers, of which one was clipped to a box whose
/// extent is the root of a variance. Where colours of about 1 are all the same, that variance is what rounding left of
/// them, 3e-7, its root 5e-4, and a squared change of up to 1 is off by twice that.
inline double squared_change(double value) { return 1e-3 + half_ulp(value); }

/// One unit in the last place of the blue channel's five bits; averages of halves are summed in halves.
inline double one_small_float(double value) { return std::abs(value) / 32 + 1e-5; }

using Tolerance = std::function<double(double)>;
using IsCompared = std::function<bool(unsigned, unsigned)>;

/// All channels of `theirs` within the tolerance in at least 99.9 % of the pixels compared.
inline void expect_near(const std::string& what, const HostImage& ours, const HostImage& theirs,
                        const IsCompared& is_compared, const Tolerance& tolerance) {
    size_t compared = 0, off = 0;
    double worst = 0;
    glm::uvec2 worst_at{0, 0};
    for (unsigned y = 0; y < theirs.extent.y; ++y)
        for (unsigned x = 0; x < theirs.extent.x; ++x) {
            if (!is_compared(x, y)) continue;
            ++compared;
            double excess = 0;
            for (unsigned c = 0; c < theirs.channels; ++c) {
                const double golden = theirs.pixel(x, y)[c], difference = std::abs(ours.pixel(x, y)[c] - golden);
                excess = std::max(excess, difference <= tolerance(golden) ? 0 : difference / tolerance(golden));
                if (std::isnan(difference)) excess = INFINITY;
            }
            if (excess > 0) ++off;
            if (excess > worst) worst = excess, worst_at = {x, y};
        }
    ASSERT_GT(compared, 50u) << what;
    EXPECT_LE(double(off), 0.001 * double(compared))
        << what << ": " << off << " of " << compared << " are off, at worst " << worst << " times the tolerance at "
        << worst_at.x << ", " << worst_at.y;
}
