#include "metrics/video_jod.h"

#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

using Frames = std::vector<HostImage>;

constexpr glm::uvec2 extent{48, 40};
constexpr size_t frame_count = 12;

/// A moving texture with fine and coarse contrasts, of radiance 0.1 to 1.
Frames scene() {
    Frames frames;
    for (size_t f = 0; f < frame_count; ++f) {
        HostImage& image = frames.emplace_back(HostImage(extent, 3));
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x)
                for (unsigned c = 0; c < 3; ++c) {
                    const double u = double(x) + double(f);
                    image.values[3 * (size_t(y) * extent.x + x) + c] =
                        float(0.45 + 0.2 * std::sin(0.9 * u + 0.3 * y) + 0.12 * std::sin(0.13 * u - 0.21 * y + c));
                }
    }
    return frames;
}

/// Gamma noise of a relative variance; one draw for all frames if it is static, as references of one pose have it.
Frames noisy(const Frames& truth, double relative_variance, bool is_static, std::mt19937_64& random) {
    std::gamma_distribution<double> gamma(1 / relative_variance, relative_variance);
    std::vector<double> factors;
    Frames frames = truth;
    for (HostImage& image : frames) {
        if (!is_static || factors.empty()) {
            factors.resize(image.values.size());
            for (double& factor : factors) factor = gamma(random);
        }
        for (size_t i = 0; i < image.values.size(); ++i) image.values[i] *= float(factors[i]);
    }
    return frames;
}

Frames blurred(const Frames& truth) {
    Frames frames = truth;
    for (size_t f = 0; f < truth.size(); ++f)
        for (size_t i = 3; i + 3 < truth[f].values.size(); ++i)
            frames[f].values[i] = (truth[f].values[i - 3] + 2 * truth[f].values[i] + truth[f].values[i + 3]) / 4;
    return frames;
}

Frames mean(const Frames& a, const Frames& b) {
    Frames frames = a;
    for (size_t f = 0; f < a.size(); ++f)
        for (size_t i = 0; i < a[f].values.size(); ++i) frames[f].values[i] = (a[f].values[i] + b[f].values[i]) / 2;
    return frames;
}

TemporalScore score(const Frames& test, const Frames& truth, const Frames& a, const Frames& b,
                    std::vector<double>* noise = nullptr) {
    VideoJod video(extent, {}, 30);
    for (size_t f = 0; f < test.size(); ++f) video.add(test[f], {truth[f], a[f], b[f]}, true);
    TemporalScore row = video.score();
    if (noise) *noise = video.noise();
    return row;
}

}  // namespace

TEST(VideoJod, IsTheScoreOfAVideoOnTheUsualDisplay) {
    const Frames truth = scene(), test = blurred(truth);
    CvvdpVideo video(extent, MetricSettings().viewing, 30, TemporalPadding::replicate);
    for (size_t f = 0; f < truth.size(); ++f) video.add(truth[f], test[f]);
    const TemporalScore row = score(test, truth, truth, truth);
    EXPECT_EQ(row.value, video.score().jod);
    EXPECT_EQ(row.low, row.value) << "a truth without noise leaves none";
    EXPECT_EQ(row.high, row.value);
    EXPECT_EQ(row.pixels, truth.size() * truth[0].pixel_count());
    EXPECT_EQ(score(truth, truth, truth, truth).value, 10);
}

TEST(VideoJod, SeesEarlierFrames) {
    const Frames truth = scene(), test = blurred(truth);
    CvvdpVideo all(extent, MetricSettings().viewing, 30, TemporalPadding::warm_up);
    VideoJod later(extent, {}, 30);
    for (size_t f = 0; f < truth.size(); ++f) {
        all.add(truth[f], test[f]);  // scores frames from the ninth on, as the filters have nine taps
        later.add(test[f], {truth[f], truth[f], truth[f]}, f >= 8);
    }
    const TemporalScore row = later.score();
    EXPECT_EQ(row.value, all.score().jod);
    EXPECT_EQ(row.pixels, 4 * truth[0].pixel_count());
    EXPECT_NE(error_message([&] {
                  CvvdpVideo video(extent, MetricSettings().viewing, 30, TemporalPadding::replicate);
                  video.add(truth[0], test[0]);
                  video.add_earlier(truth[1], test[1]);
              }).find("before those that are scored"),
              std::string::npos);
}

TEST(VideoJod, WhatCannotBeScoredHasAReason) {
    const Frames truth = scene();
    const auto note = [](const Frames& test, const Frames& of_truth, double rate, size_t count) {
        VideoJod video(test[0].extent, {}, rate);
        for (size_t f = 0; f < count; ++f) video.add(test[f], {of_truth[f], of_truth[f], of_truth[f]}, true);
        const TemporalScore row = video.score();
        EXPECT_EQ(std::isnan(row.value), !row.note.empty());
        EXPECT_FALSE(row.low);
        return row.note;
    };
    EXPECT_NE(note(truth, truth, 1000, 4).find("1000"), std::string::npos);
    EXPECT_EQ(note(truth, truth, 30, 1), "a video has two frames or more");
    const Frames tiny(4, HostImage({3, 3}, 3));
    EXPECT_NE(note(tiny, tiny, 30, 4).find("4x4"), std::string::npos);
    Frames broken = truth;
    for (size_t i = 0; i < 3 * 39; i += 3) broken[1].values[i] = NAN;  // of 3840 pixels
    EXPECT_NE(note(broken, truth, 30, 2).find("more than 1 %"), std::string::npos);
}

/// Of made-up truths with noise, for four kinds of tests and three variances.
TEST(VideoJod, IntervalsHoldTheScoreAgainstTheTruthWithoutNoise) {
    std::mt19937_64 random(1);
    const Frames truth = scene();
    const Frames tests[] = {truth, blurred(truth), noisy(truth, 0.02, false, random), noisy(truth, 0.02, true, random)};
    constexpr int draws = 3;
    int covered = 0, all = 0;
    double squared_deviations = 0, predicted = 0, width_of_least = 0;
    for (const Frames& test : tests) {
        const double exact = score(test, truth, truth, truth).value;
        for (const bool is_static : {false, true})
            for (const double variance : {1.0 / 64, 1.0 / 256, 1.0 / 1024}) {
                std::vector<double> values;
                for (int i = 0; i < draws; ++i) {
                    const Frames a = noisy(truth, 2 * variance, is_static, random),
                                 b = noisy(truth, 2 * variance, is_static, random);
                    std::vector<double> noise;
                    const TemporalScore row = score(test, mean(a, b), a, b, &noise);
                    values.push_back(row.value), ++all;
                    for (const double part : noise) predicted += part * part;
                    ASSERT_TRUE(row.low && row.high);
                    covered += *row.low <= exact && exact <= *row.high;
                    if (variance < 0.001) width_of_least = std::max(width_of_least, *row.high - *row.low);
                }
                double sum = 0;
                for (const double v : values) sum += v;
                for (const double v : values) squared_deviations += std::pow(v - sum / draws, 2) * draws / (draws - 1);
            }
    }
    EXPECT_GE(covered, 0.93 * all);
    EXPECT_LT(width_of_least, 1);  // else the interval would say nothing
    // 48 deviations are known to 10 %. Parts of strong noise are larger than its deviation, as bands mask each other.
    EXPECT_GT(std::sqrt(predicted / squared_deviations), 0.9);
    EXPECT_LT(std::sqrt(predicted / squared_deviations), 2);
}

TEST(VideoJod, NoIntervalFromANoisyTruth) {
    std::mt19937_64 random(2);
    const Frames truth = scene(), a = noisy(truth, 0.2, true, random), b = noisy(truth, 0.2, true, random);
    std::vector<double> noise;
    const TemporalScore row = score(truth, mean(a, b), a, b, &noise);
    EXPECT_LT(row.value, 10);
    EXPECT_FALSE(row.low || row.high);
    EXPECT_TRUE(noise.empty());
}
