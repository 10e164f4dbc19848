#include "metrics/frame_difference.h"
#include "core/error.h"
#include "metrics/statistics/estimates.h"
#include "tests/metrics/sequences.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(64, 64);

/// A bright bar that moves by a pixel per frame.
HostImage truth_at(unsigned frame) {
    HostImage image(extent, 3, 0.5f);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 20 + frame; x < 30 + frame; ++x) image.set_rgb(y * extent.x + x, {2, 1, 0.7f});
    return image;
}

const std::vector<Mask> all = {full_mask(extent)};

TemporalScore first_score(std::span<const HostImage> tests, std::span<const MetricReference> references) {
    FrameDifference difference;
    for (size_t t = 1; t < tests.size(); ++t)
        difference.add(tests[t - 1], tests[t], references[t - 1], references[t], all);
    return difference.scores()[0];
}

}  // namespace

TEST(FrameDifference, ABiasThatStaysIsNotSeenAndALagIs) {
    HostImage before = truth_at(0), now = truth_at(1);
    const std::array references = {exact_reference(before), exact_reference(now)};
    for (HostImage* image : {&before, &now})
        for (float& v : image->values) v += 0.25f;
    EXPECT_EQ(first_score(std::array{before, now}, references).value, 0);

    // The bar's two borders, of 64 columns, are missed.
    FrameDifference stuck;
    stuck.add(before, before, references[0], references[1], all);
    const std::vector<TemporalScore> scores = stuck.scores();
    ASSERT_EQ(scores.size(), 2u);
    EXPECT_EQ(scores[0].metric->name, "frame_difference");
    EXPECT_NEAR(scores[0].value, 2.0 / 64 * (1.5 * 1.5 + 0.5 * 0.5 + 0.2 * 0.2) / 3, 1e-8);
    EXPECT_FALSE(scores[0].corrected);
    EXPECT_FALSE(scores[0].low);
    // Relative to the later frame: the new bar at one border, the ground at the other.
    const auto term = [](double d, double r) { return d * d / (r * r + 0.01); };
    const double expected =
        term(1.5, 2) + term(0.5, 1) + term(0.2, 0.7) + term(1.5, 0.5) + term(0.5, 0.5) + term(0.2, 0.5);
    EXPECT_EQ(scores[1].metric->name, "frame_difference_relative");
    EXPECT_NEAR(scores[1].value, expected / 3 / 64, 1e-7);
}

TEST(FrameDifference, TheReferencesNoiseIsTakenOutWithoutBias) {
    Random random(3);
    std::vector<HostImage> tests;
    std::vector<MetricReference> exact;
    for (unsigned t = 0; t < 4; ++t) {
        tests.push_back(plus_noise(truth_at(t), 0.2f, random));
        exact.push_back(exact_reference(truth_at(t)));
    }
    const double expected = first_score(tests, exact).value;
    EXPECT_NEAR(expected, 2 * 0.2 * 0.2, 0.002);  // two frames' noise; 4 of its deviation, 0.08 sqrt(3 / 36864)

    constexpr int repeats = 200;
    std::vector<double> corrected, uncorrected;
    int covered = 0;
    for (int i = 0; i < repeats; ++i) {
        std::vector<MetricReference> noisy;  // each is part of two steps
        for (unsigned t = 0; t < 4; ++t) noisy.push_back(noisy_reference(truth_at(t), 0.3f, random));
        const TemporalScore row = first_score(tests, noisy);
        EXPECT_TRUE(row.corrected);
        corrected.push_back(row.value);
        uncorrected.push_back(*row.uncorrected);
        covered += *row.low <= expected && expected <= *row.high;
    }
    const Estimate mean = mean_estimate(corrected);
    const double standard_error = (mean.high - mean.value) / 1.972;  // Student's t of 199 degrees
    // Four standard errors: a false alarm of 6e-5, and the seed is fixed.
    EXPECT_NEAR(mean.value, expected, 4 * standard_error);
    // Two references of variance 0.3^2 / 2 each on top.
    EXPECT_NEAR(mean_estimate(uncorrected).value, expected + 0.09, 0.002);
    // Of 200, 190 are meant; a standard deviation is 3.1: 4.9 of them below. All 200 would come about once in 28000.
    EXPECT_GE(covered, 175);
    EXPECT_LE(covered, 199);
}

TEST(FrameDifference, OneReferenceForBothFramesHasNoNoise) {
    Random random(4);
    const MetricReference reference = noisy_reference(truth_at(0), 0.5f, random);
    HostImage now = truth_at(0);
    for (float& v : now.values) v += 0.5f;
    FrameDifference difference;
    difference.add(truth_at(0), now, reference, reference, all);
    const TemporalScore row = difference.scores()[0];
    EXPECT_NEAR(row.value, 0.25, 1e-7);  // differences of floats
    EXPECT_EQ(*row.low, row.value);
    EXPECT_EQ(*row.high, row.value);
}

TEST(FrameDifference, MasksCountTheirPixelsOverAllSteps) {
    const MetricReference reference = exact_reference(HostImage(extent, 3));
    Mask some = full_mask(extent), none = full_mask(extent);
    some.name = "some", none.name = "none";
    some.inside.assign(extent.x * extent.y, 0);
    none.inside = some.inside;
    some.inside[5] = some.inside[6] = 1;
    HostImage broken(extent, 3, 1.0f);
    broken.set_rgb(5, glm::vec3(NAN));
    FrameDifference difference;
    difference.add(HostImage(extent, 3), HostImage(extent, 3, 2.0f), reference, reference, std::array{some, none});
    difference.add(HostImage(extent, 3), broken, reference, reference, std::array{some, none});
    const std::vector<TemporalScore> scores = difference.scores();
    ASSERT_EQ(scores.size(), 4u);
    EXPECT_EQ(scores[0].mask, "some");
    EXPECT_EQ(scores[0].pixels, 3u);
    EXPECT_EQ(scores[0].left_out, 1u);
    EXPECT_EQ(scores[0].value, (4 + 4 + 1) / 3.0);
    EXPECT_TRUE(std::isnan(scores[2].value));
    EXPECT_EQ(scores[2].note, no_pixel);
    EXPECT_THROW(difference.add(broken, broken, reference, reference, std::array{none, some}), Error);
    EXPECT_THROW(difference.add(broken, HostImage({3, 3}, 3), reference, reference, std::array{some, none}), Error);
}
