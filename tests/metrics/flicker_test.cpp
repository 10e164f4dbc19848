#include "metrics/flicker.h"
#include "core/error.h"
#include "tests/metrics/sequences.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

std::vector<TemporalScore> scores_of(const FlickerMoments& moments, const MetricReference* reference = nullptr) {
    const Mask all = full_mask(moments.frames.extent);
    return flicker_scores(moments, reference, std::span(&all, 1));
}

}  // namespace

TEST(Flicker, AnExponentialHistoryHasItsClosedForm) {
    // y_t = (1 - a) y_(t-1) + a x_t of white noise x with deviation s: variance s^2 a / (2 - a), correlation 1 - a.
    const double a = 0.2, s = 0.5, phi = 1 - a, variance = s * s * a / (2 - a);
    const unsigned frames = 200;
    const glm::uvec2 extent(64, 64);
    Random random(5);
    HostImage y =
        plus_noise(HostImage(extent, 3, 2.0f), float(std::sqrt(variance)), random);  // stationary from here on
    FlickerMoments moments;
    for (unsigned t = 0; t < frames; ++t) {
        moments.add(y);
        const HostImage x = plus_noise(HostImage(extent, 3, 2.0f), float(s), random);
        for (size_t i = 0; i < y.values.size(); ++i) y.values[i] += float(a) * (x.values[i] - y.values[i]);
    }
    // Frames that are correlated have a smaller variance around their own mean: E[s^2] = (T v - sum of all covariances
    // / T) / (T - 1).
    double covariances = frames * variance;
    for (unsigned k = 1; k < frames; ++k) covariances += 2 * (frames - k) * variance * std::pow(phi, k);
    const double expected = (frames * variance - covariances / frames) / (frames - 1);
    EXPECT_NEAR(expected / variance, 1 - 2 * (1 - a) / (a * frames), 1e-3);  // what the header says, to first order

    const MetricReference reference = exact_reference(HostImage(extent, 3, 2.0f));
    const std::vector<TemporalScore> scores = scores_of(moments, &reference);
    ASSERT_EQ(scores.size(), 3u);
    EXPECT_EQ(scores[0].metric->name, "flicker");
    EXPECT_EQ(scores[1].metric->name, "flicker_relative");
    EXPECT_EQ(scores[2].metric->name, "flicker_correlation");
    // 12288 series of about 200 (1 - phi^2) / (1 + phi^2) = 44 independent values: the variance is known to 0.2 %, its
    // root to 0.1 %; four of these. The correlation follows, (1 - rho) x 0.3 %.
    EXPECT_NEAR(scores[0].value / std::sqrt(expected), 1, 0.004);
    EXPECT_NEAR(scores[1].value / (expected / (4 + 0.01)), 1, 0.008);
    EXPECT_NEAR(scores[2].value, 1 - variance * (1 - phi) / expected, 0.003);
    EXPECT_LT(*scores[0].low, scores[0].value);
    EXPECT_GT(*scores[0].high, scores[0].value);
    EXPECT_EQ(scores[0].pixels, 64u * 64);
}

TEST(Flicker, TooFewFramesOfALongHistoryTellNothing) {
    // Weight 0.2: 40 frames are asked for, somewhat fewer by a correlation that comes out low itself.
    Random random(7);
    HostImage y({32, 32}, 3);
    FlickerMoments moments;
    for (int t = 0; t < 40; ++t) {
        const HostImage x = plus_noise(HostImage({32, 32}, 3), 1, random);
        for (size_t i = 0; i < y.values.size(); ++i) y.values[i] += 0.2f * (x.values[i] - y.values[i]);
        if (t >= 20) moments.add(y);
    }
    const std::vector<TemporalScore> scores = scores_of(moments);
    EXPECT_TRUE(std::isnan(scores[0].value));
    EXPECT_FALSE(scores[0].low || scores[0].high);
    EXPECT_NE(scores[0].note.find("20 frames are too few"), std::string::npos) << scores[0].note;
    EXPECT_GT(scores[1].value, 0.6);  // the correlation itself stays
}

TEST(Flicker, FramesWithoutHistoryAreNotCorrelated) {
    Random random(6);
    FlickerMoments moments;
    for (int t = 0; t < 20; ++t) moments.add(plus_noise(HostImage({64, 64}, 3), 1, random));
    // The ratio of two means over 12288 x 19 values, each known to about 0.4 %.
    EXPECT_NEAR(scores_of(moments)[1].value, 0, 0.016);
}

TEST(Flicker, IntervalsCoverTheTruthAtTheirRateThoughNeighboursShareNoise) {
    const glm::uvec2 extent(64, 64);
    Random random(7);
    const int trials = 1500;
    int covered = 0;
    for (int trial = 0; trial < trials; ++trial) {
        FlickerMoments moments;
        for (int t = 0; t < 6; ++t) {
            const HostImage blocks = plus_noise(HostImage({8, 8}, 3), 1, random);
            HostImage frame(extent, 3);
            for (unsigned y = 0; y < 64; ++y)
                for (unsigned x = 0; x < 64; ++x)
                    for (int c = 0; c < 3; ++c) frame.pixel(x, y)[c] = blocks.pixel(x / 8, y / 8)[c];
            moments.add(frame);
        }
        const TemporalScore row = scores_of(moments)[0];
        covered += *row.low <= 1 && 1 <= *row.high;
    }
    // 1500 trials at 95 % have a standard deviation of 0.56 %; four of them fail falsely once in 16000. Intervals a
    // quarter wider than right cover 98.6 %, a fifth narrower 89 %.
    EXPECT_NEAR(double(covered) / trials, 0.95, 0.0225);
}

TEST(Flicker, StillFramesHaveExactlyNone) {
    FlickerMoments moments;
    for (int t = 0; t < 3; ++t) moments.add(HostImage({4, 4}, 3, 0.1f));
    const std::vector<TemporalScore> scores = scores_of(moments);
    EXPECT_EQ(scores[0].value, 0);
    EXPECT_TRUE(std::isnan(scores[1].value));
    EXPECT_EQ(scores[1].note, "nothing flickers");
}

TEST(Flicker, APixelThatIsOnceNotFiniteIsLeftOutAndCounted) {
    FlickerMoments moments;
    HostImage image({3, 1}, 3, 1.0f);
    moments.add(image);
    for (const float bad : {NAN, INFINITY}) {
        image.set_rgb(bad == INFINITY ? 1 : 0, {1, bad, 1});
        image.set_rgb(2, glm::vec3(bad == INFINITY ? 1 : 3));
        moments.add(image);
    }
    const std::vector<TemporalScore> scores = scores_of(moments);
    EXPECT_EQ(scores[0].pixels, 1u);
    EXPECT_EQ(scores[0].left_out, 2u);
    EXPECT_NEAR(scores[0].value, std::sqrt(4.0 / 3), 1e-12);     // of 1, 3, 1
    EXPECT_NEAR(scores[1].value, 1 - 4 / (2 * 4.0 / 3), 1e-12);  // two steps of 4
    EXPECT_FALSE(scores[0].low);                                 // a single tile

    Mask bad_ones = full_mask({3, 1});
    bad_ones.inside = {1, 1, 0};
    for (const TemporalScore& row : flicker_scores(moments, nullptr, std::span(&bad_ones, 1))) {
        EXPECT_TRUE(std::isnan(row.value));
        EXPECT_EQ(row.note, no_pixel);
    }
}

TEST(Flicker, MistakesAreNamed) {
    FlickerMoments moments;
    EXPECT_THROW(scores_of(moments), Error);
    moments.add(HostImage({4, 4}, 3));
    EXPECT_THROW(scores_of(moments), Error);
    EXPECT_THROW(moments.add(HostImage({4, 5}, 3)), Error);
    moments.add(HostImage({4, 4}, 3));
    const MetricReference reference = exact_reference(HostImage({5, 4}, 3));
    EXPECT_THROW(scores_of(moments, &reference), Error);
    EXPECT_THROW(temporal_metric_named("fliker"), Error);
}
