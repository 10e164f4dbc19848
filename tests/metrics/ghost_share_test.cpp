#include "metrics/ghost_share.h"
#include "core/error.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"
#include "tests/metrics/sequences.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(64, 64);
const std::vector<Mask> all = {full_mask(extent)};

/// A bright bar that moves by two pixels per frame.
HostImage truth_at(unsigned frame) {
    HostImage image(extent, 3, 0.5f);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 10 + 2 * frame; x < 20 + 2 * frame; ++x) image.set_rgb(y * extent.x + x, {2, 1, 0.7f});
    return image;
}

std::vector<HostImage> truths(unsigned count) {
    std::vector<HostImage> all_frames;
    for (unsigned t = 0; t < count; ++t) all_frames.push_back(truth_at(t));
    return all_frames;
}

/// Frames that hold the share of a history of the truth, by the definition in ghost_share.h.
std::vector<HostImage> with_history(const std::vector<HostImage>& truth, double share) {
    std::vector<HostImage> frames = truth;
    std::vector<double> history(truth[0].values.begin(), truth[0].values.end());
    for (size_t t = 1; t < truth.size(); ++t)
        for (size_t i = 0; i < history.size(); ++i) {
            if (t > 1) history[i] = 0.9 * history[i] + 0.1 * truth[t - 1].values[i];
            frames[t].values[i] += float(share * (history[i] - truth[t].values[i]));
        }
    return frames;
}

std::vector<TemporalScore> scores_of(const std::vector<HostImage>& frames,
                                     const std::vector<MetricReference>& references) {
    GhostShare share;
    for (size_t t = 1; t < frames.size(); ++t) share.add(frames[t], references[t - 1], references[t], all);
    return share.scores();
}

}  // namespace

TEST(GhostShare, IsTheShareOfTheHistoryThatFramesHold) {
    const std::vector<HostImage> truth = truths(6);
    std::vector<MetricReference> exact;
    for (const HostImage& image : truth) exact.push_back(exact_reference(image));
    for (const double share : {0.0, 0.25, 1.0, -0.5}) {
        const std::vector<TemporalScore> scores = scores_of(with_history(truth, share), exact);
        ASSERT_EQ(scores.size(), 1u);
        EXPECT_EQ(scores[0].metric->name, "ghost_share");
        EXPECT_NEAR(scores[0].value, share, 1e-6);  // floats of about 1
        EXPECT_FALSE(scores[0].low);
    }
}

TEST(GhostShare, AnErrorThatIsNoOldImageIsNoGhost) {
    const std::vector<HostImage> truth = truths(6);
    std::vector<MetricReference> exact;
    for (const HostImage& image : truth) exact.push_back(exact_reference(image));
    std::vector<HostImage> frames = truth;
    for (HostImage& frame : frames)
        for (unsigned y = 0; y < extent.y; ++y)  // where the bar never is
            for (unsigned x = 50; x < 60; ++x) frame.set_rgb(y * extent.x + x, {3, 3, 3});
    EXPECT_NEAR(scores_of(frames, exact)[0].value, 0, 1e-9);
}

/// Both sums hold the noise of the references: the first one's alone would cover 75 % at -0.5.
TEST(GhostShare, TheReferencesNoiseIsTakenOutWithoutBias) {
    const std::vector<HostImage> truth = truths(6);
    for (const double share : {-0.5, 0.2, 1.0, 2.0}) {
        Random random(5);
        const std::vector<HostImage> frames = with_history(truth, share);
        std::vector<double> values, half_widths;
        int covered = 0;
        constexpr int runs = 80;
        for (int run = 0; run < runs; ++run) {
            std::vector<MetricReference> references;
            for (const HostImage& image : truth) references.push_back(noisy_reference(image, 0.3f, random));
            const TemporalScore score = scores_of(frames, references)[0];
            ASSERT_TRUE(score.corrected && score.low && score.high);
            values.push_back(score.value), half_widths.push_back((*score.high - *score.low) / 2);
            covered += *score.low <= share && share <= *score.high;
        }
        const Estimate mean = mean_estimate(values);
        EXPECT_LT(mean.low, share);
        EXPECT_GT(mean.high, share);
        EXPECT_LT(mean.high - mean.low, 0.02 * std::max(1.0, std::abs(share)))
            << "the test would see a bias of a twentieth";
        // 95 % of 80, less four deviations of a binomial count: 76 - 8.
        EXPECT_GE(covered, 68) << share;
        // 1.99 deviations, which 80 runs know to 8 %: within three of that.
        const double deviation = (mean.high - mean.low) / 2 / student_t_quantile(0.975, runs - 1) * std::sqrt(runs);
        EXPECT_NEAR(mean_estimate(half_widths).value, 1.99 * deviation, 0.24 * 1.99 * deviation) << share;
    }
}

TEST(GhostShare, SaysNothingWhereTheTruthDoesNotVisiblyChange) {
    Random random(6);
    const std::vector<HostImage> still(4, truth_at(0));
    const MetricReference one = noisy_reference(truth_at(0), 0.3f, random);
    EXPECT_TRUE(scores_of(still, {one, one, one, one}).empty()) << "one reference of a pose that stays";
    std::vector<MetricReference> others;
    for (const HostImage& image : still) others.push_back(noisy_reference(image, 0.3f, random));
    const TemporalScore lost = scores_of(still, others)[0];
    EXPECT_TRUE(std::isnan(lost.value));
    EXPECT_NE(lost.note.find("not distinguishable from the noise"), std::string::npos);
}
