// What a frame takes at a large size, told by three small ones.
#include "experiments/study/plan/growth.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

constexpr std::array<double, 3> pixels = {64 * 36, 160 * 90, 320 * 180};
constexpr double large = 1920 * 1080;

std::array<double, 3> seconds_of(double fixed, double share, double power) {
    std::array<double, 3> seconds{};
    for (size_t i = 0; i < seconds.size(); ++i) seconds[i] = fixed + share * std::pow(pixels[i], power);
    return seconds;
}

/// 40 halvings of [1, 3/2] leave 5e-13 of the power, which is 1e-11 of what a size of e^14.5 pixels takes.
TEST(Growth, TellsThePowerOfAMarch) {
    for (const double power : {1.0, 1.2, 1.5})
        for (const double fixed : {0.0, 0.004})
            EXPECT_NEAR(growth_through(pixels, seconds_of(fixed, 1e-7, power)).at(large) /
                            (fixed + 1e-7 * std::pow(large, power)),
                        1, 1e-6)
                << power << " " << fixed;
}

TEST(Growth, IsNeverFasterThanAMarchNorSlowerThanAPass) {
    const Growth fast = growth_through(pixels, seconds_of(0, 1e-10, 2)),
                 slow = growth_through(pixels, seconds_of(0, 1e-5, 0.5));
    EXPECT_NEAR(fast.power, 1.5, 1e-6);
    EXPECT_NEAR(slow.power, 1, 1e-6);
    EXPECT_NEAR(fast.at(pixels[2]) / seconds_of(0, 1e-10, 2)[2], 1, 1e-9) << "the largest size counts most";
    EXPECT_NEAR(slow.at(pixels[2]) / seconds_of(0, 1e-5, 0.5)[2], 1, 1e-9);
}

TEST(Growth, OfWhatHardlyGrowsIsNone) {
    EXPECT_DOUBLE_EQ(growth_through(pixels, {0.010, 0.011, 0.0105}).at(large), 0.0105);
    EXPECT_DOUBLE_EQ(growth_through(pixels, {0, 0, 0}).at(large), 0);
}

/// Plans are judged by factors: 5 % of noise in any of the three sizes change what is told of 36 times the pixels by a
/// factor of less than 2.
TEST(Growth, BearsNoise) {
    for (const double power : {1.0, 1.25, 1.5})
        for (unsigned signs = 0; signs < 8; ++signs) {
            const std::array<double, 3> exact = seconds_of(0.001, 1e-7, power);
            std::array<double, 3> noisy = exact;
            for (size_t i = 0; i < 3; ++i) noisy[i] *= signs >> i & 1 ? 1.05 : 0.95;
            const double ratio = growth_through(pixels, noisy).at(large) / (0.001 + 1e-7 * std::pow(large, power));
            EXPECT_LT(std::abs(std::log2(ratio)), 1) << power << " " << signs;
        }
}

}  // namespace
