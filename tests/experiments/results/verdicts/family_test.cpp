// How p-values are adjusted for the choice of the best measured point.
#include "experiments/results/verdicts/family.h"

#include <gtest/gtest.h>

namespace {

using P = std::vector<double>;

P adjusted(const std::vector<AgainstBest>& comparisons, const std::vector<size_t>& points) {
    return adjusted_for_choice(comparisons, points);
}

void expect_near(const P& found, const P& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-15) << i;
}

}  // namespace

TEST(Family, OfTwoPointsHasOnePair) { expect_near(adjusted({{0, 0.03}}, {2}), {0.03}); }

TEST(Family, CountsThePairsOfThePointsThatRemain) {
    // Of four points there are 6 pairs; without the worst 3, and of the last two 1, but never less than what went
    // before.
    expect_near(adjusted({{0, 0.02}, {0, 0.001}, {0, 0.004}}, {4}), {0.02, 0.006, 0.012});
    expect_near(adjusted({{0, 0.005}, {0, 0.001}, {0, 0.004}}, {4}), {0.012, 0.006, 0.012});
    expect_near(adjusted({{0, 0.5}, {0, 0.6}}, {3}), {1, 1});
}

TEST(Family, AddsUpOverShots) {
    // 3 + 1 pairs, then 1 + 1, then 1 or 0.
    expect_near(adjusted({{0, 0.001}, {1, 0.03}, {0, 0.02}}, {3, 2}), {0.004, 0.04, 0.04});
}
