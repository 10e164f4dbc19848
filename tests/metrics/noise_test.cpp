#include "metrics/noise.h"
#include "core/error.h"
#include "metrics/score.h"
#include "metrics/statistics.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

using Random = std::mt19937;

/// A smooth, coloured truth with a step.
HostImage truth_image(glm::uvec2 extent) {
    HostImage image(extent, 3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    (x > extent.x / 2 ? 2.0f : 0.5f) + 0.3f * std::sin(0.1f * float(x + y * unsigned(c + 1)));
    return image;
}

/// The truth plus noise whose standard deviation is `relative` of it; neighbours in blocks of `correlated` pixels share
/// it.
HostImage with_noise(const HostImage& truth, float relative, Random& random, unsigned correlated = 1) {
    HostImage image = truth;
    std::normal_distribution<float> normal;
    for (unsigned y = 0; y < truth.extent.y; ++y)
        for (unsigned x = 0; x < truth.extent.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const float drawn = normal(random);
                const bool is_first = x % correlated == 0 && y % correlated == 0;
                const unsigned bx = x - x % correlated, by = y - y % correlated;
                const float shared = is_first ? drawn : image.pixel(bx, by)[c] / truth.pixel(bx, by)[c] - 1;
                image.pixel(x, y)[c] *= is_first ? 1 + relative * drawn : 1 + shared;
            }
    return image;
}

HostImage mean_of(const HostImage& a, const HostImage& b) {
    HostImage mean = a;
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = (a.values[i] + b.values[i]) / 2;
    return mean;
}

double exact(const char* metric, const HostImage& truth, const HostImage& test) {
    return measure(metric_named(metric), image_pair(truth, test, {}));
}

struct Simulation {
    std::vector<double> corrected, naive;
    int covered = 0;
};

/// Many references of the same truth against one test image.
Simulation simulate(const char* metric, const HostImage& truth, const HostImage& test, float relative_noise,
                    int repeats, unsigned correlated) {
    Random random(11);
    Simulation result;
    const Mask all = full_mask(truth.extent);
    const double expected = exact(metric, truth, test);
    for (int i = 0; i < repeats; ++i) {
        const HostImage a = with_noise(truth, relative_noise, random, correlated),
                        b = with_noise(truth, relative_noise, random, correlated);
        const MetricReference reference = metric_reference(mean_of(a, b), ReferenceHalves{a, b}, {metric}, {});
        const Score s = score(reference, test, std::span(&all, 1)).front();
        result.corrected.push_back(s.value);
        result.naive.push_back(s.uncorrected);
        result.covered += *s.low <= expected && expected <= *s.high;
    }
    return result;
}

double standard_error(const Estimate& e, size_t n) { return (e.high - e.value) / (n > 100 ? 1.97 : 2.02); }

}  // namespace

TEST(Noise, CorrectedSquaredErrorIsUnbiased) {
    const HostImage truth = truth_image({64, 64});
    Random random(3);
    const HostImage test = with_noise(truth, 0.2f, random);
    const double expected = exact("mse", truth, test);
    const Simulation s = simulate("mse", truth, test, 0.3f, 200, 1);
    const Estimate corrected = mean_estimate(s.corrected), naive = mean_estimate(s.naive);
    // Four standard errors: a false alarm of 6e-5, and the seed is fixed.
    EXPECT_NEAR(corrected.value, expected, 4 * standard_error(corrected, 200));
    EXPECT_GT(naive.value, expected * 1.5);  // the reference's own noise: 0.3^2 / 2 on top of 0.2^2
}

TEST(Noise, IntervalsCoverTheTruthAtTheirRate) {
    const HostImage truth = truth_image({96, 96});
    Random random(3);
    const HostImage test = with_noise(truth, 0.1f, random);
    // 200 trials at 95 %: a standard deviation of 1.5 %; 3.5 of them either way, and 36 tiles leave 1 % of
    // under-coverage. Noise shared by blocks of 8x8 pixels would be covered far too rarely if pixels were taken as
    // independent.
    for (const unsigned correlated : {1u, 8u}) {
        const int covered = simulate("mse", truth, test, 0.2f, 200, correlated).covered;
        EXPECT_GE(covered, 177) << correlated;
        EXPECT_LE(covered, 199) << correlated;
    }
    const int covered = simulate("bias", truth, test, 0.2f, 200, 8).covered;
    EXPECT_GE(covered, 177);
    EXPECT_LE(covered, 199);
}

TEST(Noise, RelativeErrorsAreCorrectedToAFewPercent) {
    const HostImage truth = truth_image({64, 64});
    Random random(3);
    const HostImage test = with_noise(truth, 0.2f, random);
    const double expected = exact("relmse", truth, test);
    const Simulation s = simulate("relmse", truth, test, 0.2f, 50, 1);
    // The weight 1 / (r^2 + 0.01) comes from an estimate of r, so a bias of second order stays; the naive one is off by
    // half.
    EXPECT_NEAR(mean_estimate(s.corrected).value / expected, 1, 0.05);
    EXPECT_GT(mean_estimate(s.naive).value / expected, 1.4);
}

TEST(Noise, EqualHalvesChangeNothing) {
    const HostImage truth = truth_image({40, 30});
    Random random(3);
    const HostImage test = with_noise(truth, 0.2f, random);
    const Mask all = full_mask(truth.extent);
    for (const char* name : {"mse", "rmse", "relmse", "relmse_b", "relmse_c", "relmse_d"}) {
        const MetricReference reference = metric_reference(truth, ReferenceHalves{truth, truth}, {name}, {});
        const Score s = score(reference, test, std::span(&all, 1)).front();
        EXPECT_TRUE(s.corrected);
        EXPECT_NEAR(s.value / s.uncorrected, 1, 1e-12) << name;  // the same sum, in another association
        EXPECT_EQ(*s.low, s.value) << name;
        EXPECT_EQ(*s.floor, 0) << name;
    }
}

TEST(Noise, TheSmoothedReferenceIsNearerToTheTruth) {
    const HostImage truth = truth_image({64, 64});
    Random random(3);
    const HostImage a = with_noise(truth, 0.3f, random), b = with_noise(truth, 0.3f, random);
    EXPECT_LT(exact("mse", truth, without_noise(a, b)), 0.5 * exact("mse", truth, mean_of(a, b)));
    EXPECT_EQ(without_noise(truth, truth).values, truth.values);
}

TEST(Score, RowsHoldMetricsTimesMasks) {
    const HostImage truth = truth_image({40, 30});
    Random random(3);
    const HostImage a = with_noise(truth, 0.1f, random), b = with_noise(truth, 0.1f, random);
    HostImage test = with_noise(truth, 0.1f, random);
    test.set_rgb(5, glm::vec3(NAN));
    std::vector<Mask> masks = {full_mask(truth.extent), full_mask(truth.extent)};
    masks[1].name = "none";
    masks[1].inside.assign(masks[1].inside.size(), 0);
    const MetricReference reference =
        metric_reference(mean_of(a, b), ReferenceHalves{a, b}, {"mse", "flip", "bias"}, {});
    PixelCounts counts;
    const std::vector<Score> scores = score(reference, test, masks, &counts);
    ASSERT_EQ(scores.size(), 6u);
    EXPECT_EQ(counts.nan, 1u);
    EXPECT_EQ(scores[0].pixels, 40u * 30 - 1);
    EXPECT_EQ(scores[1].mask, "none");
    EXPECT_TRUE(std::isnan(scores[1].value));
    EXPECT_FALSE(scores[1].low);
    EXPECT_EQ(scores[2].metric->name, "flip");
    EXPECT_FALSE(scores[2].corrected);
    EXPECT_FALSE(scores[2].low);
    EXPECT_GT(*scores[2].floor, 0);
    EXPECT_TRUE(scores[4].low);
    EXPECT_THROW(metric_reference(truth, std::nullopt, {"msee"}, {}), Error);
    EXPECT_THROW(score(reference, HostImage({3, 3}, 3), masks), Error);
}
