#include "metrics/jod_interval.h"

#include "metrics/score.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

constexpr glm::uvec2 extent{64, 48};

/// Fine and coarse contrasts, of radiance 0.1 to 1.
HostImage scene() {
    HostImage image(extent, 3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (unsigned c = 0; c < 3; ++c)
                image.values[3 * (size_t(y) * extent.x + x) + c] =
                    float(0.45 + 0.2 * std::sin(0.9 * x + 0.3 * y) + 0.12 * std::sin(0.13 * x - 0.21 * y + c));
    return image;
}

/// Gamma noise of a relative variance, which is never negative, as that of a path tracer.
HostImage noisy(const HostImage& truth, double relative_variance, std::mt19937_64& random) {
    std::gamma_distribution<double> gamma(1 / relative_variance, relative_variance);
    HostImage image = truth;
    for (float& value : image.values) value *= float(gamma(random));
    return image;
}

HostImage mapped(const HostImage& truth, const auto& map) {
    HostImage image = truth;
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = map(i, truth.values[i]);
    return image;
}

Score score_of_still(const HostImage& test, const HostImage& truth, std::optional<ReferenceHalves> halves) {
    const MetricReference reference = metric_reference(truth, std::move(halves), {"cvvdp_0_5_6"}, {});
    return score(reference, test, std::vector{full_mask(extent)}).front();
}

Score score_with_noise(const HostImage& test, const HostImage& truth, double variance, std::mt19937_64& random) {
    ReferenceHalves halves{.a = noisy(truth, 2 * variance, random),
                           .b = noisy(truth, 2 * variance, random),
                           .variance = HostImage(extent, 3, 1e-4f),
                           .guide = truth,
                           .samples = 64};
    const HostImage mean =
        mapped(truth, [&](size_t i, float) { return (halves.a.values[i] + halves.b.values[i]) / 2; });
    return score_of_still(test, mean, halves);
}

}  // namespace

TEST(JodInterval, HoldsTheScoreOfAStillAgainstTheTruthWithoutNoise) {
    std::mt19937_64 random(1);
    const HostImage truth = scene();
    const size_t shift = 3;  // one pixel
    const HostImage tests[] = {
        mapped(truth, [&](size_t i, float) { return truth.values[i < shift ? i : i - shift]; }),
        mapped(truth, [](size_t, float value) { return 0.8f * value; }),
        mapped(truth, [](size_t i, float value) { return i % 600 < 90 ? 0.3f : value; }),  // bars
        noisy(truth, 0.02, random)};
    constexpr int draws = 16;
    int covered = 0, all = 0;
    for (const HostImage& test : tests) {
        const double exact = score_of_still(test, truth, {}).value;
        for (const double variance : {1.0 / 64, 1.0 / 256, 1.0 / 1024})
            for (int i = 0; i < draws; ++i) {
                const Score row = score_with_noise(test, truth, variance, random);
                if (!row.low) continue;  // at the limit of noise, some are above
                covered += *row.low <= exact && exact <= *row.high, ++all;
                EXPECT_LE(*row.low, row.value);
                EXPECT_GE(*row.high, row.value);
            }
    }
    // 480 draws covered 96 %. Of 192, 91 % or less would be an accident of 1 in 1000.
    EXPECT_GE(all, 180);
    EXPECT_GE(covered, 0.91 * all);
}

/// A rare bright path changes all bands in one direction. Their changes alone would scatter half as much as the score.
TEST(JodInterval, DrawsScatterAsTheWholeScoreDoes) {
    const auto differences_of = [](double in_each_band) {
        VisibleDifferences bands(6);  // the last, which has the lowest frequencies, sees nothing
        for (size_t i = 0; i + 1 < bands.size(); ++i) bands[i].fill(in_each_band);
        return std::vector<VisibleDifferences>{bands};
    };
    const DifferenceFrom differences{
        .truth = differences_of(25), .half_a = differences_of(32), .half_b = differences_of(22)};
    double squares = 0;
    for (const double draw : jod_interval(differences, /*is_still=*/false).draws) squares += draw * draw;
    const double change = (jod_of(differences.half_a, false) - jod_of(differences.half_b, false)) / 2;
    EXPECT_NEAR(std::sqrt(squares), std::abs(change), 0.02 * std::abs(change)) << "but for the bend of the JOD's curve";
}

TEST(JodInterval, ATruthWithoutNoiseLeavesNone) {
    const HostImage truth = scene(),
                    test = mapped(truth, [](size_t i, float value) { return i % 600 < 90 ? 0.3f : value; });
    const Score row = score_of_still(
        test, truth,
        ReferenceHalves{.a = truth, .b = truth, .variance = HostImage(extent, 3), .guide = truth, .samples = 64});
    EXPECT_LT(row.value, 10);
    EXPECT_EQ(row.low, row.value);
    EXPECT_EQ(row.high, row.value);
}

TEST(JodInterval, NoneFromANoisyTruth) {
    std::mt19937_64 random(2);
    const HostImage truth = scene();
    const Score row = score_with_noise(truth, truth, 0.1, random);
    EXPECT_LT(row.value, 10);
    EXPECT_FALSE(row.low || row.high);
}

/// Light above the display's peak is not shown, and its noise neither.
TEST(JodInterval, NoiseBeyondTheDisplayDoesNotCount) {
    const Viewing viewing = MetricSettings().viewing;
    const float peak = float(viewing.display.peak / viewing.nits_per_unit);
    const HostImage a(extent, 3, 2 * peak), b(extent, 3, 3 * peak);
    EXPECT_EQ(relative_noise(a, b, viewing), 0);
    EXPECT_NEAR(relative_noise(HostImage(extent, 3, 0.9f), HostImage(extent, 3, 1.1f), viewing), 0.01 / 1.01, 1e-6);
}
