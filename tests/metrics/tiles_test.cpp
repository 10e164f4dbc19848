#include "metrics/tiles.h"
#include "metrics/metric.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

namespace {

double mean(std::span<const double> totals) { return totals[1] / totals[0]; }

}  // namespace

TEST(Tiles, SumsAreThoseOfTheirPixels) {
    const glm::uvec2 extent(40, 17);  // three by two tiles, the last ones cut off
    Plane plane(extent);
    Mask mask = full_mask(extent);
    for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = double(i);
    mask.inside[0] = mask.inside[39] = 0;
    EXPECT_EQ(tile_counts(mask), (std::vector<double>{255, 256, 127, 16, 16, 8}));
    const std::vector<double> sums = tile_sums(plane, mask);
    EXPECT_EQ(sums[5], 8 * (16 * 40 + 32 + 39 + 16 * 40) / 2.0);
    EXPECT_EQ(totals(std::array{sums})[0], 679 * 680 / 2.0 - 39);
}

TEST(Tiles, TheJackknifeOfAMeanIsStudentsInterval) {
    // Of equal tiles it is t s / sqrt(n), exactly; here of 1, 2, 4 and 9: s^2 = 38 / 3, t(0.975, 3) = 3.182446.
    const std::vector<double> counts = {10, 0, 10, 10, 10}, sums = {10, 0, 20, 40, 90};
    EXPECT_NEAR(*jackknife_half_width(std::array{counts, sums}, mean), 3.182446 * std::sqrt(38 / 3.0 / 4), 1e-5);
    const std::vector<double> one_count = {10, 0}, one_sum = {3, 0};
    EXPECT_FALSE(jackknife_half_width(std::array{one_count, one_sum}, mean));
    EXPECT_FALSE(jackknife_half_width(std::array{counts, std::vector<double>(5, NAN)}, mean));
}
