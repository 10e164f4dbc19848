// Ratios of times: paired by frame, with intervals that allow for slow changes of the machine's speed.
#include "experiments/results/verdicts/effects/time_effects.h"
#include "metrics/statistics/median_interval.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

const std::vector<ComparedPoint> two_points = {{.technique = "v", .point = "base", .is_baseline = true},
                                               {.technique = "v", .point = "slow"}};

TimeRow time_of(const std::string& point, const std::string& stage, unsigned round, double milliseconds) {
    return {"s", "v", point, 0, stage, round, milliseconds, "host_fence"};
}

}  // namespace

TEST(TimeEffects, PairTheFrames) {
    // Frames differ by up to a factor of 1000, the points by one of 2, but for a frame that was disturbed.
    std::vector<TimeRow> times;
    for (unsigned round = 0; round < 15; ++round) {
        const double frame = std::pow(10.0, 3 * std::sin(round));
        times.push_back(time_of("base", "total", round, frame));
        for (const double half : {0.5, 1.5})  // a stage may run twice in a frame
            times.push_back(time_of("slow", "total", round, half * frame * (round == 4 ? 50 : 1)));
        times.push_back(time_of("slow", "of its own", round, 1));
    }
    const std::vector<TimeEffectRow> effects = time_effects(times, two_points);
    ASSERT_EQ(effects.size(), 1u) << "of the stages that both have";
    EXPECT_EQ(effects[0].point, "slow");
    EXPECT_EQ(effects[0].against_point, "base");
    EXPECT_EQ(effects[0].rounds, 15u);
    EXPECT_DOUBLE_EQ(effects[0].ratio, 2);
    EXPECT_NEAR(effects[0].low, 2, 1e-12);
    EXPECT_NEAR(effects[0].high, 2, 1e-12) << "one frame of 15 does not count";
}

/// Logarithms of ratios as on a busy machine: heavy tails, and half of the variance lasts for some rounds.
TEST(TimeEffects, CoverTheRatioWhereDisturbancesLast) {
    std::mt19937 random(7);
    std::student_t_distribution<double> jitter(3);
    std::normal_distribution<double> normal;
    constexpr int studies = 2000;
    for (const size_t rounds : {15, 60}) {
        int covered = 0;
        for (int study = 0; study < studies; ++study) {
            std::vector<double> ratios;
            double load = normal(random);
            for (size_t i = 0; i < rounds; ++i) {
                load = 0.6 * load + 0.8 * normal(random);
                ratios.push_back(1.7 * std::exp(0.1 * load + 0.06 * jitter(random)));
            }
            const Estimate m = median_interval(ratios);
            EXPECT_LE(m.low, m.value);
            EXPECT_GE(m.high, m.value);
            covered += m.low <= 1.7 && 1.7 <= m.high;
        }
        // A binomial count of 95 % has a deviation of 9.7; independent signs would give 86 and 82 %. The
        // autocorrelation of few rounds is not known well: 93 % is asked for, less four and a half deviations for a
        // false alarm of 1e-5.
        EXPECT_GE(covered, 0.93 * studies - 4.5 * std::sqrt(0.93 * 0.07 * studies)) << rounds;
    }
}

TEST(TimeEffects, KnowNothingOfAFrameThatOnlyOneWasTimedIn) {
    const std::vector<TimeRow> times = {time_of("base", "total", 0, 1), time_of("slow", "total", 1, 2)};
    EXPECT_TRUE(time_effects(times, two_points).empty());
}
