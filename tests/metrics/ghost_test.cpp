#include "metrics/ghost.h"
#include "core/error.h"
#include "metrics/statistics/estimates.h"
#include "tests/metrics/sequences.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(48, 48);
const Mask all = full_mask(extent);

/// The scene changes in its left half.
HostImage state(float left) {
    HostImage image(extent, 3, 0.4f);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x / 2; ++x) image.set_rgb(y * extent.x + x, {left, left / 2, left / 4});
    return image;
}
const HostImage old_state = state(2), new_state = state(0.5f);

/// What remains of the old state at each age, plus an error that stays, plus noise.
std::vector<HostImage> played(const std::vector<double>& remains, float bias, float noise, Random& random) {
    std::vector<HostImage> frames;
    for (const double rest : remains) {
        HostImage frame = new_state;
        for (size_t i = 0; i < frame.values.size(); ++i)
            frame.values[i] += float(rest) * (old_state.values[i] - new_state.values[i]) + bias;
        frames.push_back(plus_noise(std::move(frame), noise, random));
    }
    return frames;
}

/// An exponential history of weight a: already the first frame takes the share a of the new state.
std::vector<double> exponential(double a, unsigned frames) {
    std::vector<double> rest;
    for (unsigned age = 0; age < frames; ++age) rest.push_back(std::pow(1 - a, age + 1));
    return rest;
}
double exact_length(double a) { return std::ceil(std::log(0.05) / std::log(1 - a)) - 1; }

Ghost ghost_of(const std::vector<HostImage>& frames, const MetricReference& before, const MetricReference& after) {
    return ghost_scores(frames, before, after, std::span(&all, 1)).front();
}
Ghost exact_ghost(const std::vector<double>& remains, float bias = 0) {
    Random random(1);
    return ghost_of(played(remains, bias, 0, random), exact_reference(old_state), exact_reference(new_state));
}

}  // namespace

TEST(Ghost, AnExponentialHistoryHasItsClosedForm) {
    const Ghost ghost = exact_ghost(exponential(0.1, 96));
    EXPECT_EQ(exact_length(0.1), 28);  // 0.9^28 = 0.052, 0.9^29 = 0.047
    EXPECT_EQ(ghost.ghost_length.value, 28);
    EXPECT_EQ(ghost.settling_length.value, 15);  // 0.9^(2 k) < 0.05
    EXPECT_EQ(*ghost.ghost_length.low, 28);      // the same in every tile
    EXPECT_EQ(*ghost.ghost_length.high, 28);
    ASSERT_EQ(ghost.share.size(), 96u);
    EXPECT_NEAR(ghost.share[0], 0.9, 0.001);  // the plateau still holds 0.9^85 = 1e-4 of the old image
    EXPECT_NEAR(ghost.error[0], 0.81 * 1.5 * 1.5 * (1 + 0.25 + 1 / 16.0) / 3 / 2, 1e-6);
    EXPECT_EQ(ghost.ghost_length.metric->name, "ghost_length");
    EXPECT_EQ(ghost.ghost_length.pixels, 48u * 48);
}

TEST(Ghost, AnErrorThatStaysIsNoGhost) {
    EXPECT_EQ(exact_ghost(exponential(0.1, 96), 0.7f).ghost_length.value, 28);
    // A technique that never shows more than the new state and its own error.
    const Ghost none = exact_ghost(std::vector<double>(16, 0.0), 0.7f);
    EXPECT_EQ(none.ghost_length.value, 0);
    EXPECT_EQ(none.settling_length.value, 0);
}

TEST(Ghost, WithoutAFirstStepThereIsNothingToSettle) {
    Random random(4);
    const std::vector<double> at_once(16, 0.0);
    const MetricReference before = exact_reference(old_state), after = exact_reference(new_state);
    // Means over 6912 values of noise: the first frame's error differs from the plateau's, by far less than 5 % of
    // 0.49.
    EXPECT_EQ(ghost_of(played(at_once, 0.7f, 0.1f, random), before, after).settling_length.value, 0);
    // With errors of 4 sqrt(2 / 6912) = 0.07, 14 % of the change, that is no longer measurable.
    const TemporalScore row = ghost_of(played(at_once, 0, 2, random), before, after).settling_length;
    EXPECT_TRUE(std::isnan(row.value));
    EXPECT_EQ(row.note, "the error of the first frame is not distinguishable from the plateau's");
}

TEST(Ghost, LengthsInTheFirstHalfAreRightToFivePercent) {
    int given = 0, withheld = 0;
    for (double a = 0.04; a < 0.5; a *= 1.1) {
        const TemporalScore row = exact_ghost(exponential(a, 64)).ghost_length;
        std::isnan(row.value) ? ++withheld : ++given;
        if (std::isnan(row.value)) continue;
        EXPECT_LE(row.value, exact_length(a)) << a;
        EXPECT_GE(row.value, 0.95 * exact_length(a) - 1) << a;  // lengths are whole frames
    }
    EXPECT_GT(given, 12);
    EXPECT_GT(withheld, 5);
    const TemporalScore slow = exact_ghost(exponential(0.04, 64)).ghost_length;
    EXPECT_EQ(slow.note, "not within the first half of 64 frames");
    EXPECT_FALSE(slow.low);
}

TEST(Ghost, WhatReturnsOrOvershootsIsStillThere) {
    std::vector<double> rest(32, 0.0);
    rest[0] = 0.5;
    EXPECT_EQ(exact_ghost(rest).ghost_length.value, 1);
    rest[9] = 0.06;
    EXPECT_EQ(exact_ghost(rest).ghost_length.value, 10);
    rest[9] = -0.06;
    EXPECT_EQ(exact_ghost(rest).ghost_length.value, 10);
    rest[9] = -0.04;
    EXPECT_EQ(exact_ghost(rest).ghost_length.value, 1);
}

TEST(Ghost, NoiseOfFramesAndReferencesAveragesOut) {
    Random random(2);
    constexpr int repeats = 60;
    std::vector<double> first_shares;
    int covered = 0;
    for (int i = 0; i < repeats; ++i) {
        // In each half, two thirds of what the change is in its strongest channel.
        const MetricReference before = noisy_reference(old_state, 1, random);
        const MetricReference after = noisy_reference(new_state, 1, random);
        const Ghost ghost = ghost_of(played(exponential(0.25, 32), 0.1f, 0.5f, random), before, after);
        ASSERT_FALSE(ghost.share.empty());
        first_shares.push_back(ghost.share[0]);
        const TemporalScore& row = ghost.ghost_length;
        covered += !std::isnan(row.value) && *row.low <= exact_length(0.25) &&
                   exact_length(0.25) <= row.high.value_or(INFINITY);
    }
    // With the references' noise of 2 x 1 / 2 in the denominator, on top of a change of 0.49, it would come out at
    // 0.25. Four standard errors: a false alarm of 2e-4, and the seed is fixed; a ratio is biased by about the square
    // of the denominator's relative deviation, 0.06^2.
    const Estimate mean = mean_estimate(first_shares);
    EXPECT_NEAR(mean.value, 0.75, 4 * (mean.high - mean.value) / 2.001 + 0.004);
    EXPECT_GE(covered, 53);  // 95 % of 60 less 2.4 standard deviations
}

TEST(Ghost, AChangeThatIsNotThereHasNoGhost) {
    Random random(3);
    for (int i = 0; i < 20; ++i) {
        const MetricReference before = noisy_reference(new_state, 0.5f, random);
        const MetricReference after = noisy_reference(new_state, 0.5f, random);
        const Ghost ghost = ghost_of(played(std::vector<double>(12, 0.0), 0, 0.1f, random), before, after);
        // Four half-widths are eight standard deviations.
        EXPECT_TRUE(std::isnan(ghost.ghost_length.value));
        EXPECT_NE(ghost.settling_length.note.find("noise of the reference"), std::string::npos);
        EXPECT_EQ(ghost.error.size(), 12u);
    }
    const MetricReference same = exact_reference(new_state);
    EXPECT_TRUE(
        std::isnan(ghost_of(played(std::vector<double>(12, 0.0), 0, 0, random), same, same).ghost_length.value));
}

TEST(Ghost, PixelsThatAreOnceNotFiniteAreLeftOutOfAllFrames) {
    Random random(1);
    std::vector<HostImage> frames = played(exponential(0.1, 96), 0, 0, random);
    frames[3].set_rgb(0, {NAN, 0, 0});
    frames[7].set_rgb(1, {0, INFINITY, 0});
    std::vector<Mask> masks(2, all);
    masks[1].name = "broken";
    masks[1].inside.assign(masks[1].inside.size(), 0);
    masks[1].inside[0] = 1;
    const std::vector<Ghost> ghosts =
        ghost_scores(frames, exact_reference(old_state), exact_reference(new_state), masks);
    EXPECT_EQ(ghosts[0].ghost_length.value, 28);
    EXPECT_EQ(ghosts[0].ghost_length.left_out, 2u);
    EXPECT_EQ(ghosts[1].ghost_length.note, no_pixel);
    EXPECT_THROW(ghost_of({frames.begin(), frames.begin() + 7}, exact_reference(old_state), exact_reference(new_state)),
                 Error);
    EXPECT_THROW(ghost_of(frames, exact_reference(HostImage({2, 2}, 3)), exact_reference(new_state)), Error);
}
