#include "metrics/statistics.h"
#include "core/error.h"
#include "metrics/quantiles.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

TEST(Quantiles, MatchTables) {
    // NIST/SEMATECH e-Handbook, section 1.3.6.7, to its three digits; the longer ones are closed forms.
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
    EXPECT_NEAR(student_t_quantile(0.975, 1), std::tan(M_PI * 0.475), 1e-10);  // Cauchy
    EXPECT_NEAR(student_t_quantile(0.975, 2), 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95)),
                1e-10);  // closed form of two degrees
    EXPECT_NEAR(student_t_quantile(0.975, 7), 2.365, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.975, 100), 1.984, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.975, 1e8), normal_quantile(0.975), 1e-6);  // differs by (z^3 + z) / (4 degrees)
    EXPECT_NEAR(student_t_quantile(0.025, 7), -student_t_quantile(0.975, 7), 1e-10);
    EXPECT_NEAR(chi_square_quantile(0.95, 2), -2 * std::log(0.05), 1e-10);  // exponential
    EXPECT_NEAR(chi_square_quantile(0.95, 1), std::pow(normal_quantile(0.975), 2), 1e-10);
    EXPECT_NEAR(chi_square_quantile(0.95, 10), 18.307, 5e-4);
    EXPECT_NEAR(chi_square_quantile(0.05, 100), 77.929, 5e-4);
    EXPECT_THROW(normal_quantile(1), Error);
    EXPECT_THROW(student_t_quantile(0.5, 0), Error);
}

TEST(Statistics, IntervalOfTheMean) {
    const std::vector<double> values = {1, 2, 3, 4, 5};
    const Estimate e = mean_estimate(values);
    EXPECT_NEAR(e.value, 3, 1e-12);
    EXPECT_NEAR(e.high - e.value, 2.776 * std::sqrt(2.5 / 5), 5e-4);  // t(0.975, 4) of the tables
    EXPECT_NEAR(e.value - e.low, e.high - e.value, 1e-12);
    EXPECT_THROW(mean_estimate(std::vector<double>{1}), Error);
}

TEST(Statistics, PairedRatio) {
    const std::vector<double> b = {1, 10, 100, 1000}, a = {2.1, 19, 205, 1990};
    const RatioEstimate r = paired_ratio(a, b);
    EXPECT_NEAR(r.ratio.value, std::pow(2.1 * 1.9 * 2.05 * 1.99, 0.25), 1e-12);
    EXPECT_LT(r.ratio.low, 2);
    EXPECT_GT(r.ratio.high, 2);
    EXPECT_GT(r.ratio.low, 1.8);  // pairs take out the factor of 1000 between scenes
    EXPECT_LT(r.p_value, 0.001);
    EXPECT_NEAR(paired_ratio(a, a).p_value, 1, 1e-12);
    EXPECT_THROW(paired_ratio(a, std::vector<double>{1, 2}), Error);
    EXPECT_THROW(paired_ratio(std::vector<double>{1, 0}, std::vector<double>{1, 2}), Error);
}

TEST(Statistics, Holm) {
    const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005});
    const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};  // 3 x 0.01, max(0.06, 0.04), 2 x 0.03, 4 x 0.005
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-15);
}

TEST(Statistics, ErrorIsSplitIntoBiasAndVariance) {
    // Independent seeds around truth + 0.1 with standard deviation 1, against a reference whose halves have 0.5 each.
    const glm::uvec2 extent(128, 128);
    std::mt19937 random(9);
    std::normal_distribution<float> normal;
    HostImage truth(extent, 3, 2.0f);
    const auto noisy = [&](float offset, float deviation) {
        HostImage image = truth;
        for (float& v : image.values) v += offset + deviation * normal(random);
        return image;
    };
    SeedMoments seeds;
    for (int i = 0; i < 8; ++i) seeds.add(noisy(0.1f, 1));
    const ReferenceHalves halves{noisy(0, 0.5f), noisy(0, 0.5f)};
    HostImage reference = truth;
    for (size_t i = 0; i < reference.values.size(); ++i)
        reference.values[i] = (halves.a.values[i] + halves.b.values[i]) / 2;

    const Mask all = full_mask(extent);
    const ErrorSplit split = split_error(seeds, reference, halves, all);
    // 49152 values: the variance's mean has sd sqrt(2 / 7 / 49152) = 0.0024. The product (m - A)(m - B) has a variance
    // of (1/8 + 0.25)^2 + (1/8)^2 = 0.16, V / 8 one of 2 / 7 / 64 = 0.004, so the bias^2 has sd 0.0018. Four of each.
    EXPECT_NEAR(split.variance, 1, 0.0097);
    EXPECT_NEAR(split.bias_squared, 0.01, 0.0075);
    EXPECT_EQ(split.mse, split.bias_squared + split.variance);
    // Without the halves the reference's variance of 0.125 counts as bias.
    EXPECT_NEAR(split_error(seeds, reference, std::nullopt, all).bias_squared, 0.135, 0.0075);
    EXPECT_THROW(split_error(SeedMoments{}, reference, std::nullopt, all), Error);
    EXPECT_THROW(seeds.add(HostImage({2, 2}, 3)), Error);
}

TEST(Statistics, APixelThatOneSeedBreaksIsLeftOut) {
    SeedMoments seeds;
    HostImage image({2, 1}, 3, 1.0f);
    seeds.add(image);
    image.set_rgb(0, glm::vec3(NAN));
    image.set_rgb(1, glm::vec3(3));
    seeds.add(image);
    EXPECT_EQ(seeds.finite.count(), 1u);
    const ErrorSplit split = split_error(seeds, HostImage({2, 1}, 3, 1.0f), std::nullopt, full_mask({2, 1}));
    EXPECT_NEAR(split.variance, 2, 1e-12);      // of 1 and 3
    EXPECT_NEAR(split.bias_squared, 0, 1e-12);  // (2 - 1)^2 - 2 / 2
}
