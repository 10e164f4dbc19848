// Towards a reference without noise: laws that are known, and noise that is made.
#include "metrics/extrapolation.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

TEST(Extrapolation, HoldsWhatFollowsItsLaws) {
    constexpr double truth = 0.3;
    const auto holds = [&](const std::function<double(double)>& added) {
        const Extrapolated e = without_noise(truth + added(1), truth + added(2), truth + added(4));
        EXPECT_LE(e.low(), truth + 1e-9);
        EXPECT_GE(e.high(), truth - 1e-9);
        EXPECT_LE(e.low(), truth + added(1));
        EXPECT_GE(e.high(), truth + added(1)) << "the mean as it is";
        return std::abs(e.high() - e.low()) / std::abs(added(1));
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
    EXPECT_EQ(exact.low(), 0.3);
    EXPECT_EQ(exact.high(), 0.3);
}

namespace {

constexpr unsigned size = 128, trials = 300;
const Mask whole{.name = "all", .extent = {size, size}, .inside = std::vector<uint8_t>(size * size, 1)};

/// Of means of absolute differences against a reference of Gaussian noise, which is the same for all `errors` (in
/// deviations of the reference's noise). A quarter of the pixels has the last of them, in all.
std::vector<NoiseGrowth> growths(std::mt19937& random, const std::vector<double>& errors) {
    std::normal_distribution<double> normal;
    std::vector<double> a, b;
    for (unsigned i = 0; i < size * size; ++i)
        a.push_back(std::sqrt(2.0) * normal(random)), b.push_back(std::sqrt(2.0) * normal(random));
    std::vector<NoiseGrowth> all;
    for (const double error : errors) {
        std::vector<Plane> maps(5, Plane({size, size}));
        for (unsigned i = 0; i < size * size; ++i) {
            const double mean = (a[i] + b[i]) / 2, move = extrapolation_step * (a[i] - b[i]) / 2,
                         own = i % 4 == 0 ? errors.back() : error;
            const double noises[] = {mean, a[i], b[i], mean + move, mean - move};
            for (size_t k = 0; k < maps.size(); ++k) maps[k].values[i] = std::abs(own - noises[k]);
        }
        all.push_back(noise_growth({&maps[0], &maps[1], &maps[2], &maps[3], &maps[4]}, whole));
    }
    return all;
}

double measured(const NoiseGrowth& growth) {
    const auto first = growth.begin() + std::ptrdiff_t(size_t(GrowthColumn::at_one) * growth_groups);
    return std::accumulate(first, first + growth_groups, 0.0);
}

/// Five deviations of 95 %: a false alarm of 3e-7.
const double fewest_covered = trials * (0.95 - 5 * std::sqrt(0.95 * 0.05 / trials));

}  // namespace

/// Closed form of the truth, intervals of many references.
TEST(Extrapolation, CoversTheMeanAbsoluteDifference) {
    std::mt19937 random(5);
    for (const double error : {0.0, 0.5, 3.0}) {
        unsigned covered = 0;
        for (unsigned trial = 0; trial < trials; ++trial) {
            const auto found = extrapolated_interval(growths(random, {error}).front());
            ASSERT_TRUE(found);
            covered += found->low <= error && error <= found->high;
        }
        EXPECT_GE(covered, fewest_covered) << error;
    }
}

/// The noise that is added to small errors brings their ratio nearer to 1: what is measured alone is no estimate of it.
TEST(Extrapolation, CoversTheRatioOfTwoErrors) {
    std::mt19937 random(6);
    for (const std::vector<double>& errors : {std::vector{1.0, 1.5}, std::vector{0.8, 3.0}, std::vector{3.0, 4.0}}) {
        const double truth = (0.75 * errors[0] + 0.25 * errors[1]) / errors[1];
        unsigned covered = 0, covered_without = 0;
        double half_width = 0;
        for (unsigned trial = 0; trial < trials; ++trial) {
            const std::vector<NoiseGrowth> of = growths(random, errors);
            const auto scatter = extrapolated_scatter(of[0], of[1]);
            ASSERT_TRUE(scatter);
            const Jackknifed a{measured(of[0]), {}}, b{measured(of[1]), {}};
            const RatioEstimate ratio = jackknifed_ratio(a, b, *scatter);
            covered += *ratio.low <= truth && truth <= *ratio.high;
            half_width += std::log(*ratio.high / *ratio.low) / 2 / trials;
            const RatioEstimate without =
                jackknifed_ratio(a, b, {.variance = scatter->variance, .degrees = scatter->degrees});
            covered_without += *without.low <= truth && truth <= *without.high;
        }
        EXPECT_GE(covered, fewest_covered) << errors[0];
        EXPECT_LT(half_width, 0.2) << errors[0];
        if (errors[0] < 1) {
            EXPECT_LT(covered_without, trials / 2) << "without the extrapolation";
        }
    }
}

TEST(Extrapolation, LeavesNoNoiseThatBothErrorsShare) {
    std::mt19937 random(7);
    const NoiseGrowth growth = growths(random, {0.8}).front();
    const auto scatter = extrapolated_scatter(growth, growth);
    ASSERT_TRUE(scatter);
    EXPECT_EQ(scatter->variance, 0);
    EXPECT_EQ(scatter->excess_of_a, 0);
    EXPECT_EQ(scatter->excess_of_b, 0);
}

TEST(Extrapolation, NeedsTwoTiles) {
    Plane map({16, 16});
    const Mask mask{.name = "all", .extent = {16, 16}, .inside = std::vector<uint8_t>(256, 1)};
    EXPECT_FALSE(extrapolated_interval(noise_growth({&map, &map, &map, &map, &map}, mask)));
}
