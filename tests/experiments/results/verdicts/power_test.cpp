// Which differences studies see: tables, closed forms, and simulated studies.
#include "experiments/results/verdicts/power.h"

#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

/// A ranked point whose error is `ratio` times the best's, with an interval of `half` of its logarithm.
MetricSummary ranked_point(const std::string& technique, double ratio, double half, unsigned seeds) {
    MetricSummary e{.shot = "s", .frame = "0", .technique = technique, .point = "default"};
    e.metric = "mse", e.seeds = seeds, e.value = ratio, e.standing = standing::behind;
    e.interval = seeds > 1 ? interval::reference_and_seeds : interval::reference;
    e.over_best = ratio, e.over_best_low = ratio * std::exp(-half), e.over_best_high = ratio * std::exp(half);
    return e;
}

}  // namespace

TEST(Power, IsThatOfTheNoncentralT) {
    // Without a difference it is the level; of a known error the normal's closed form: 80 % at 1.96 + 0.84 errors.
    EXPECT_NEAR(power_of_test(0, 3, 0.05), 0.05, 1e-9);
    EXPECT_NEAR(power_of_test(0, 0, 0.01), 0.01, 1e-9);
    EXPECT_NEAR(effects_seen(0, 0.05), normal_quantile(0.975) + normal_quantile(0.8), 1e-3);
    // Cohen 1988, "Statistical Power Analysis for the Behavioral Sciences", and G*Power: a paired test of 10 has 80 %
    // at d = 0.996, which is d sqrt(10) standard errors.
    EXPECT_NEAR(effects_seen(9, 0.05) / std::sqrt(10.0), 0.996, 0.005);
    EXPECT_NEAR(power_of_test(1e3, 3, 0.05), 1, 1e-9);
    // Two seeds and the comparisons of hundreds of shots: the limit is Cauchy's, and 8 of 10 standard errors are below
    // 1.28 times their expectation. effects_seen() searches to 1e-4.
    const double level = 0.05 / 1e6, limit = 1 / std::tan(M_PI * level / 2);
    EXPECT_NEAR(effects_seen(1, level) / (limit * normal_quantile(0.9)), 1, 2e-4);
}

TEST(Power, OfSimulatedStudiesIsWhatIsSaid) {
    // 8 seeds, whose logarithms scatter by 0.1 around a true difference: seen by the t test in 8 of 10.
    constexpr int studies = 4000, seeds = 8;
    const double scatter = 0.1, error = scatter / std::sqrt(double(seeds));
    const double half = student_t_quantile(0.975, seeds - 1) * error;
    for (const size_t comparisons : {size_t(1), size_t(11)}) {
        const ComparedRatio ratio{.low = std::exp(-half), .high = std::exp(half), .degrees = seeds - 1};
        const double level = significance / double(comparisons), effects = effects_seen(seeds - 1, level);
        const double share = std::expm1(effects * ratio.standard_error());
        EXPECT_NEAR(power_of_test(effects, seeds - 1, level), wanted_power, 1e-3);
        std::mt19937 random(5);
        std::normal_distribution<double> normal(std::log1p(share), scatter);
        int seen = 0;
        for (int study = 0; study < studies; ++study) {
            double sum = 0, squares = 0;
            for (int i = 0; i < seeds; ++i) {
                const double x = normal(random);
                sum += x, squares += x * x;
            }
            const double mean = sum / seeds, own = std::sqrt((squares - sum * mean) / (seeds - 1) / seeds);
            seen += 2 * student_t_cdf(-std::abs(mean) / own, seeds - 1) * double(comparisons) < significance;
        }
        // 4 standard errors of 4000 studies.
        EXPECT_NEAR(double(seen) / studies, wanted_power, 4 * std::sqrt(0.16 / studies)) << comparisons;
    }
    EXPECT_EQ((ComparedRatio{.low = 2, .high = 2, .degrees = 3}.standard_error()), 0) << "without noise all is seen";
}

TEST(Power, OfAShotIsTheMedianAndTheWorstOfItsPairs) {
    const double half = 0.1;
    const MetricSummary best = [] {
        MetricSummary e = ranked_point("best", 1, 0, 4);
        e.over_best = e.over_best_low = e.over_best_high = std::nullopt;
        return e;
    }();
    const MetricSummary a = ranked_point("a", 1.1, half, 1), b = ranked_point("b", 1.2, 2 * half, 1),
                        c = ranked_point("c", 3, 8 * half, 1);
    const std::vector<const MetricSummary*> points = {&best, &a, &b, &c};
    const auto visible = visible_in_shot(points, 3);
    ASSERT_TRUE(visible);
    const double effects = normal_quantile(1 - 0.025 / 3) + normal_quantile(0.8), z = normal_quantile(0.975);
    EXPECT_NEAR(visible->typical, std::expm1(effects * 2 * half / z), 1e-3);
    EXPECT_NEAR(visible->largest, std::expm1(effects * 8 * half / z), 2e-3);
    EXPECT_EQ(visible->of_largest.first, "c");
    EXPECT_EQ(visible->comparisons, 3u);
    EXPECT_FALSE(visible_in_shot(std::vector<const MetricSummary*>{&best}, 1));

    // The interval of few seeds is wide by their Student's t, which is no scatter of its own.
    const MetricSummary of_seeds = ranked_point("d", 1.1, student_t_quantile(0.975, 3) * 0.05, 4);
    const auto seen = visible_in_shot(std::vector<const MetricSummary*>{&of_seeds}, 1);
    EXPECT_NEAR(seen->typical, std::expm1(effects_seen(3, 0.05) * 0.05), 1e-6);
}

TEST(Power, CountsThePairsThatAreLeft) {
    std::vector<MetricSummary> errors;
    const auto add = [&](const std::string& shot, const char* standing) {
        errors.push_back(ranked_point("a", 1, 0.1, 1)), errors.back().shot = shot, errors.back().standing = standing;
    };
    for (const char* standing : {standing::tied, standing::tied, standing::equivalent, standing::behind})
        add("s", standing);
    for (const char* standing : {standing::best, standing::behind, ""}) add("t", standing);
    EXPECT_EQ(comparisons_left(errors, "", "mse", ""), 3u) << "three points of one shot, one of the other";
    EXPECT_EQ(comparisons_left(errors, "", "flip", ""), 1u);
}

TEST(Power, OverScenesIsThatOfTheirScatter) {
    // 11 scenes whose logarithms scatter by 0.3: the interval is that of n - 2 degrees.
    OverScenesRow first, row;
    first.scenes = row.scenes = 11, first.rank = 1, row.rank = 2, row.over_best = 1.2;
    const double error = 0.3 / std::sqrt(11.0), half = student_t_quantile(0.975, 9) * error;
    row.over_best_low = 1.2 * std::exp(-half), row.over_best_high = 1.2 * std::exp(half);
    const std::vector<const OverScenesRow*> rows = {&first, &row};
    const auto visible = visible_over_scenes(rows);
    ASSERT_TRUE(visible);
    EXPECT_NEAR(visible->typical, std::expm1(effects_seen(9, 0.05) * error), 1e-6);
    EXPECT_EQ(scenes_needed_for(rows), scenes_needed(0.3));
    row.scenes = 3;
    EXPECT_FALSE(visible_over_scenes(rows)) << "below four scenes nothing is known of their scatter";
    EXPECT_FALSE(scenes_needed_for(rows));
}
