// Bias and variance from pairs of seeds, and the interval of the ratio of two such.
#include "metrics/seed_pairs.h"
#include "core/error.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numeric>
#include <random>

namespace {

std::vector<size_t> first(size_t count) {
    std::vector<size_t> indices(count);
    std::iota(indices.begin(), indices.end(), size_t(0));
    return indices;
}

}  // namespace

TEST(SeedPairs, TellBiasAndVarianceInExpectation) {
    // Independent seeds around truth + 0.1 with standard deviation 1, against a reference whose halves have 0.5 each.
    const glm::uvec2 extent(128, 128);
    std::mt19937 random(9);
    std::normal_distribution<float> normal;
    const auto noisy = [&](float offset, float deviation) {
        HostImage image(extent, 3, 2.0f);
        for (float& v : image.values) v += offset + deviation * normal(random);
        return image;
    };
    std::vector<HostImage> seeds;
    for (int i = 0; i < 8; ++i) seeds.push_back(noisy(0.1f, 1));
    const HostImage a = noisy(0, 0.5f), b = noisy(0, 0.5f);
    const SeedPairs pairs = seed_pairs(seeds, a, b, full_mask(extent));
    ASSERT_EQ(pairs.variance.size(), 28u);
    // 49152 values: the variance's mean has sd sqrt(2 / 7 / 49152) = 0.0024. The product (m - A)(m - B) has a variance
    // of (1/8 + 0.25)^2 + (1/8)^2 = 0.16, V / 8 one of 2 / 7 / 64 = 0.004, so the bias^2 has sd 0.0018. Four of each.
    EXPECT_NEAR(jackknifed_pairs(pairs.variance, first(8)).value, 1, 0.0097);
    EXPECT_NEAR(jackknifed_pairs(pairs.bias_squared, first(8)).value, 0.01, 0.0075);
    // One image in place of both halves: its variance of 0.25 counts as bias.
    const SeedPairs alone = seed_pairs(seeds, a, a, full_mask(extent));
    EXPECT_NEAR(jackknifed_pairs(alone.bias_squared, first(8)).value, 0.26, 0.0075);
    EXPECT_THROW(seed_pairs(seeds, a, HostImage({2, 2}, 3), full_mask(extent)), Error);
}

TEST(SeedPairs, OfFewPixelsHaveClosedForms) {
    // Seeds 1, 3 and 8 against halves 0 and 1, in the one pixel inside.
    std::vector<HostImage> seeds;
    for (const float value : {1.0f, 3.0f, 8.0f}) {
        HostImage& image = seeds.emplace_back(glm::uvec2(2, 1), 3, NAN);
        image.set_rgb(1, glm::vec3(value));
    }
    const Mask right{.name = "right", .extent = {2, 1}, .inside = {0, 1}};
    const SeedPairs pairs = seed_pairs(seeds, HostImage({2, 1}, 3, 0.0f), HostImage({2, 1}, 3, 1.0f), right);
    EXPECT_EQ(pairs.variance, (std::vector<double>{2, 24.5, 12.5}));     // of (1, 3), (1, 8), (3, 8)
    EXPECT_EQ(pairs.bias_squared, (std::vector<double>{1, 3.5, 18.5}));  // e.g. (1 * 2 + 3 * 0) / 2
    const Jackknifed variance = jackknifed_pairs(pairs.variance, first(3));
    EXPECT_EQ(variance.value, 13);  // the sample variance of 1, 3, 8
    EXPECT_EQ(variance.without, (std::vector<double>{12.5, 24.5, 2}));
    const std::vector<size_t> outer = {0, 2};
    EXPECT_EQ(jackknifed_pairs(pairs.variance, outer).value, 24.5);
    EXPECT_TRUE(jackknifed_pairs(pairs.variance, outer).without.empty());
    EXPECT_THROW(jackknifed_pairs(pairs.variance, first(1)), Error);
}

TEST(SeedPairs, IntervalsOfRatiosCoverThem) {
    // Two techniques of 300 values that share 0.6 of their noise; the first is 1.2 times the second, so 1.44 is the
    // ratio of squared biases and of variances. bias^2 = variance.
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    const HostImage zero({100, 1}, 3);
    const int studies = 1500;
    for (const size_t count : {4, 8}) {
        int bias_covered = 0, variance_covered = 0;
        for (int study = 0; study < studies; ++study) {
            std::vector<HostImage> x(count, zero), y(count, zero);
            for (size_t seed = 0; seed < count; ++seed)
                for (size_t i = 0; i < zero.values.size(); ++i) {
                    const float shared = normal(random);
                    x[seed].values[i] = 1.2f * (1 + shared);
                    y[seed].values[i] = 1 + 0.6f * shared + 0.8f * normal(random);
                }
            const SeedPairs a = seed_pairs(x, zero, zero, full_mask({100, 1})),
                            b = seed_pairs(y, zero, zero, full_mask({100, 1}));
            const auto covers = [&](const std::vector<double>& of_a, const std::vector<double>& of_b) {
                const RatioEstimate r =
                    jackknifed_ratio(jackknifed_pairs(of_a, first(count)), jackknifed_pairs(of_b, first(count)));
                return *r.low <= 1.44 && 1.44 <= *r.high;
            };
            bias_covered += covers(a.bias_squared, b.bias_squared);
            variance_covered += covers(a.variance, b.variance);
        }
        // 95.5 to 97 % in the long run, which 1500 studies know to 0.5 %: four of that fail falsely once in 16000.
        EXPECT_NEAR(double(bias_covered) / studies, 0.9625, 0.028) << count;
        EXPECT_NEAR(double(variance_covered) / studies, 0.9625, 0.028) << count;
    }
}
