// Towards a reference without noise: laws that are known, and noise that is made.
#include "metrics/extrapolation.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <random>

TEST(Extrapolation, HoldsWhatFollowsItsLaws) {
    constexpr double truth = 0.3;
    const auto holds = [&](const std::function<double(double)>& added) {
        const Extrapolated e = without_noise(truth + added(1), truth + added(2), truth + added(4));
        EXPECT_LE(e.low, truth + 1e-9);
        EXPECT_GE(e.high, truth - 1e-9);
        EXPECT_LE(e.low, truth + added(1));
        EXPECT_GE(e.high, truth + added(1)) << "the mean as it is";
        return std::abs(e.high - e.low) / std::abs(added(1));
    };
    // What is added of the interval's own width: at most half too much.
    for (const double p : {0.25, 0.5, 0.75, 1.0})
        for (const double sign : {0.1, -0.1})
            EXPECT_LE(holds([&](double v) { return sign * std::pow(v, p); }), 1.01) << p;
    for (const double c : {0.5, 2.0, 10.0}) {
        const double width = holds([&](double v) { return 0.1 * v / (c + v); });
        EXPECT_LE(width, 5) << c;
    }
    const Extrapolated exact = without_noise(0.3, 0.3, 0.3);
    EXPECT_EQ(exact.low, 0.3);
    EXPECT_EQ(exact.high, 0.3);
}

/// Mean absolute differences of Gaussian noise: closed form of the truth, intervals of many references.
TEST(Extrapolation, CoversTheMeanAbsoluteDifference) {
    constexpr unsigned size = 128, trials = 300;
    const Mask mask{.name = "all", .extent = {size, size}, .inside = std::vector<uint8_t>(size * size, 1)};
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (const double error : {0.0, 0.5, 3.0}) {  // of the test image, in deviations of the reference's noise
        unsigned covered = 0;
        for (unsigned trial = 0; trial < trials; ++trial) {
            Plane own({size, size});
            Plane halves[2] = {own, own}, moved_on[2] = {own, own};
            for (size_t i = 0; i < own.values.size(); ++i) {
                const double a = std::sqrt(2.0) * normal(random), b = std::sqrt(2.0) * normal(random);
                const double mean = (a + b) / 2, move = extrapolation_step * (a - b) / 2;
                own.values[i] = std::abs(error - mean);
                halves[0].values[i] = std::abs(error - a), halves[1].values[i] = std::abs(error - b);
                moved_on[0].values[i] = std::abs(error - mean - move);
                moved_on[1].values[i] = std::abs(error - mean + move);
            }
            const MapInterval found = extrapolated_interval(own, halves, moved_on, mask);
            ASSERT_TRUE(found.low && found.high);
            covered += *found.low <= error && error <= *found.high;
        }
        // Five deviations of 95 % in 300 trials: a false alarm of 3e-7.
        EXPECT_GE(covered, trials * (0.95 - 5 * std::sqrt(0.95 * 0.05 / trials))) << error;
    }
}

TEST(Extrapolation, NeedsTwoTiles) {
    Plane map({16, 16});
    const Plane two[2] = {map, map};
    const Mask mask{.name = "all", .extent = {16, 16}, .inside = std::vector<uint8_t>(256, 1)};
    EXPECT_FALSE(extrapolated_interval(map, two, two, mask).low);
}
