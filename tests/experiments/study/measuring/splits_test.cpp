// How errors are split into bias and variance over the seeds.
#include "experiments/study/measuring/splits.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <random>

namespace {

HostImage noisy_image(glm::uvec2 extent, float mean, float deviation, std::mt19937& random) {
    std::normal_distribution<float> noise(mean, deviation);
    HostImage image(extent, 3);
    for (float& v : image.values) v = noise(random);
    return image;
}

/// A reference of 1 everywhere, whose halves have a standard deviation of 0.2 in every channel.
MetricReference noisy_reference(glm::uvec2 extent, std::mt19937& random) {
    const ReferenceHalves halves{.a = noisy_image(extent, 1.0f, 0.2f, random),
                                 .b = noisy_image(extent, 1.0f, 0.2f, random),
                                 .variance = HostImage(extent, 3, 0.02f),
                                 .guide = HostImage(extent, 3, 1.0f),
                                 .samples = 64};
    HostImage mean = halves.a;
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = 0.5f * (halves.a.values[i] + halves.b.values[i]);
    return metric_reference(mean, halves, {"mse"}, {});
}

}  // namespace

TEST(Splits, FindTheBiasAndTheVariance) {
    // Bias 0.5 and standard deviation 0.3 in every channel of 64x64 pixels and 16 seeds; halves of a reference of 1
    // with a standard deviation of 0.2.
    std::mt19937 random(1);
    const MetricReference reference = noisy_reference({64, 64}, random);
    SeedSplit split{reference};
    for (unsigned seed = 0; seed < 16; ++seed) split.add(seed, noisy_image({64, 64}, 1.5f, 0.3f, random));
    const std::vector<Mask> masks = {full_mask({64, 64}),
                                     {.name = "none", .extent = {64, 64}, .inside = std::vector<uint8_t>(64 * 64)}};
    const std::vector<SplitRow> rows = split_rows(split, masks, {.shot = "s"});
    ASSERT_EQ(rows.size(), 1u) << "an empty mask has no row";
    const SplitRow& row = rows.front();
    // 12288 x 15 samples know the variance to 0.33 %. The mean of reference and seeds, whose deviation is 0.2 / sqrt(2)
    // and 0.3 / 4 in 12288 values, shifts the bias by 0.0014, its square by 0.0014. Four standard deviations.
    EXPECT_NEAR(row.variance, 0.09, 4 * 0.0003);
    EXPECT_NEAR(row.bias_squared, 0.25, 4 * 0.0014);
    EXPECT_DOUBLE_EQ(row.mse, row.bias_squared + row.variance);
    EXPECT_LT(*row.variance_low, 0.09);
    EXPECT_GT(*row.variance_high, 0.09);
    EXPECT_LT(*row.variance_high - *row.variance_low, 0.09 * 0.05);
    EXPECT_LT(*row.bias_squared_low, 0.25);
    EXPECT_GT(*row.bias_squared_high, 0.25);
    EXPECT_NEAR(*row.bias_squared_high - *row.bias_squared_low, 2 * 2 * 0.0014, 0.0028)
        << "two standard deviations each way";
}

TEST(Splits, HaveIntervalsOfTheWidthOfIndependentPairs) {
    // Bias 1 and standard deviation 0.3 in 48 values and 16 seeds, against a reference without noise. The mean of
    // (1 + e)(1 + f) over 8 disjoint pairs has the variance (2 * 0.09 + 0.0081) / 48 / 8, that of (e - f)^2 / 2 has
    // 2 * 0.0081 / 48 / 8. Student's t of their 7 degrees is 2.3646. The square of half a width scatters by 0.53 to
    // 0.57 of itself, its mean over 400 studies by 0.028: 15 % are five of these, a false alarm of 6e-7. All 15 pairs
    // of successive seeds would give 0.42 of it.
    std::mt19937 random(7);
    std::normal_distribution<float> noise(1.0f, 0.3f);
    const MetricReference reference = metric_reference(HostImage({8, 2}, 3), {}, {}, {});
    const std::vector<Mask> masks = {full_mask({8, 2})};
    constexpr int studies = 400;
    double bias_square = 0, variance_square = 0;
    int bias_covered = 0, variance_covered = 0;
    for (int study = 0; study < studies; ++study) {
        SeedSplit split{reference};
        for (unsigned seed = 0; seed < 16; ++seed) {
            HostImage image({8, 2}, 3);
            for (float& v : image.values) v = noise(random);
            split.add(seed, image);
        }
        const SplitRow row = split_rows(split, masks, {}).at(0);
        bias_square += std::pow(*row.bias_squared_high - row.bias_squared, 2) / studies;
        variance_square += std::pow(*row.variance_high - row.variance, 2) / studies;
        bias_covered += *row.bias_squared_low <= 1 && 1 <= *row.bias_squared_high;
        variance_covered += *row.variance_low <= 0.09 && 0.09 <= *row.variance_high;
    }
    const double bias_truth = 2.3646 * 2.3646 * (2 * 0.09 + 0.0081) / 48 / 8;
    const double variance_truth = 2.3646 * 2.3646 * 2 * 0.0081 / 48 / 8;
    EXPECT_NEAR(bias_square, bias_truth, 0.15 * bias_truth);
    EXPECT_NEAR(variance_square, variance_truth, 0.15 * variance_truth);
    // 95 %, and of the variance 98.7 %, which all pairs know better than disjoint ones: four and a half deviations of
    // 4.4, and more than five of 2.3, are false alarms of 1e-5. With all successive pairs 84 % would hold the bias.
    EXPECT_GE(bias_covered, 360);
    EXPECT_GE(variance_covered, 382);
}

TEST(Splits, HoldTheNoiseOfTheReferenceInTheIntervalOfTheBias) {
    // Seeds without any scatter: all that is uncertain of the bias of 0.5 is the reference, whose halves have a
    // standard deviation of 0.2 in 12288 values.
    std::mt19937 random(2);
    const MetricReference reference = noisy_reference({64, 64}, random);
    SeedSplit split{reference};
    for (unsigned seed = 0; seed < 4; ++seed) split.add(seed, HostImage({64, 64}, 3, 1.5f));
    const SplitRow row = split_rows(split, std::vector{full_mask({64, 64})}, {.shot = "s"}).at(0);
    EXPECT_EQ(row.variance, 0.0);
    EXPECT_EQ(*row.variance_high, 0.0);
    // d(bias^2) = 2 bias d(bias); the interval's own estimate comes from 4096 pixels, +-1.1 %: five of that, and what
    // the square of the noise adds.
    const double half_width = 1.96 * 2 * 0.5 * 0.2 / std::sqrt(2.0 * 12288);
    EXPECT_NEAR(*row.bias_squared_high - row.bias_squared, half_width, 0.08 * half_width);
    EXPECT_NEAR(row.bias_squared - *row.bias_squared_low, half_width, 0.08 * half_width);
}

TEST(Splits, HoldWhatNoisyLightMayHaveAdded) {
    // A reference of 0 without noise, and seeds of 1, 1, 1 and 3 everywhere. Of the pairs 1 * 1 and 1 * 3 the mean has
    // a standard error of 1, and Student's t of one degree is 12.7062. All six pairs estimate a squared bias of 2.
    const glm::uvec2 extent(32, 16);
    const HostImage none(extent, 3);
    const MetricReference reference = metric_reference(
        none, ReferenceHalves{.a = none, .b = none, .variance = none, .guide = none, .samples = 16}, {"mse"}, {});
    SeedSplit split{reference};
    for (unsigned seed = 0; seed < 4; ++seed) split.add(seed, HostImage(extent, 3, seed == 3 ? 3.0f : 1.0f));
    // Light of half A gives 5, of half B 1: it adds (5 - 1)^2 / 4 = 4, and half of the change is (25 - 1) / 2 = 12 in
    // both tiles of the image. Student's t of two degrees is 4.30265.
    PoseTruth pose;
    pose.targets.emplace("specular", reference);
    pose.direct = none;
    const std::vector<Mask> masks = {full_mask(extent)};
    LitNoiseOfErrors light = unknown_lit_noise;
    add_lit_noise_of_targets(light, pose, {.specular = HostImage(extent, 3, 5.0f)},
                             {.specular = HostImage(extent, 3, 1.0f)}, masks, "0");
    const double of_light = 4.30265 * 12 / std::sqrt(2.0);
    const SplitRow shared{.frame = "0", .target = "specular"};
    const SplitRow clean = split_rows(split, masks, shared).at(0),
                   noisy = split_rows(split, masks, shared, true, light).at(0);
    EXPECT_DOUBLE_EQ(clean.bias_squared, 2);
    EXPECT_NEAR(*clean.bias_squared_low, 2 - 12.7062, 1e-3);
    EXPECT_NEAR(*clean.bias_squared_high, 2 + 12.7062, 1e-3);
    EXPECT_EQ(noisy.bias_squared, clean.bias_squared);
    EXPECT_NEAR(*noisy.lit_noise, 4, 1e-12);
    EXPECT_NEAR(*noisy.bias_squared_low, 2 - std::hypot(12.7062, of_light) - 4, 1e-3);
    EXPECT_NEAR(*noisy.bias_squared_high, 2 + std::hypot(12.7062, of_light), 1e-3);
    EXPECT_EQ(noisy.variance_low, clean.variance_low) << "all seeds read the same light";
    EXPECT_EQ(noisy.variance_high, clean.variance_high);
}

TEST(Splits, NeedTwoSeeds) {
    const MetricReference reference = metric_reference(HostImage({8, 8}, 3), {}, {}, {});
    SeedSplit split{reference};
    split.add(0, HostImage({8, 8}, 3));
    EXPECT_TRUE(split_rows(split, std::vector{full_mask({8, 8})}, {}).empty());
    split.add(1, HostImage({8, 8}, 3, 2.0f));
    const std::vector<SplitRow> rows = split_rows(split, std::vector{full_mask({8, 8})}, {});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].variance, 2.0);      // of 0 and 2
    EXPECT_EQ(rows[0].bias_squared, 0.0);  // (0 - 0)(2 - 0), or 1 - 2 / 2
    EXPECT_FALSE(rows[0].variance_low) << "one pair has no interval";
}

TEST(Splits, OfAPointWithoutSeedsAreAllBias) {
    std::mt19937 random(3);
    const std::vector<Mask> masks = {full_mask({16, 16})};
    const MetricReference reference = noisy_reference({16, 16}, random);
    SeedSplit split{reference};
    split.add(5, HostImage({16, 16}, 3, 1.5f));
    EXPECT_TRUE(split_rows(split, masks, {}).empty());
    const SplitRow row = split_rows(split, masks, {}, false).at(0);
    EXPECT_EQ(row.variance, 0.0);
    EXPECT_EQ(row.seeds, 1u);
    // Doubles in another order.
    EXPECT_NEAR(row.bias_squared, score(reference, split.images[0], masks).at(0).value, 1e-12);
    EXPECT_LT(*row.bias_squared_low, row.bias_squared);
    EXPECT_GT(*row.bias_squared_high, row.bias_squared);
}
