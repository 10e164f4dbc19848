// What holds over scenes: closed forms, brute force, and how often what is truly the best is said to be behind.
#include "experiments/results/verdicts/effects/over_scenes.h"

#include "core/error.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"

#include "metrics/statistics/quantiles.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

/// Logarithms of errors by scene, of points "a", "b", ...: the baseline's error is 1 in all.
std::vector<ShotErrors> shots_of(const std::vector<std::vector<double>>& of_points) {
    std::vector<ShotErrors> shots;
    for (size_t i = 0; i < of_points.front().size(); ++i) {
        ShotErrors& shot =
            shots.emplace_back(ShotErrors{.asset = "scene " + std::to_string(i), .divisor = {{1, 1, 1}}, .errors = {}});
        for (size_t p = 0; p < of_points.size(); ++p) {
            const double error = std::exp(of_points[p][i]);
            shot.errors[{std::string(1, char('a' + p)), ""}] = {error, error, error};
        }
    }
    return shots;
}

std::map<std::string, OverScenes> by_name(const std::vector<OverScenes>& rows) {
    std::map<std::string, OverScenes> found;
    for (const OverScenes& row : rows) found[row.technique] = row;
    return found;
}

double variance_of(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / double(values.size());
    for (const double v : values) squares += (v - mean) * (v - mean);
    return squares / double(values.size() - 1);
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> values;
    for (size_t i = 0; i < a.size(); ++i) values.push_back(a[i] - b[i]);
    return values;
}

}  // namespace

TEST(OverScenes, MeansAreStudentsOverAssets) {
    const std::vector<ShotValue> values = {{"a", 0}, {"a", 2}, {"b", 2}, {"c", 3}, {"d", 4}};
    const MeanOverScenes mean = mean_over_scenes(values);
    EXPECT_EQ(mean.scenes, 4u);
    EXPECT_DOUBLE_EQ(mean.value, 2.5);
    // Standard error sqrt(5 / 3) / 2; of 2 degrees of freedom quantile(q) = (2 q - 1) / sqrt(2 q (1 - q)),
    // and p = 1 - t / sqrt(2 + t^2).
    const double error = std::sqrt(5.0 / 3) / 2, t = 2.5 / error, quantile = 0.95 / std::sqrt(2 * 0.975 * 0.025);
    EXPECT_NEAR(*mean.high - 2.5, quantile * error, 1e-12);
    EXPECT_NEAR(2.5 - *mean.low, quantile * error, 1e-12);
    EXPECT_NEAR(*mean.p, 1 - t / std::sqrt(2 + t * t), 1e-12);
}

/// Of 1000 trials, 0.8 +- 4 standard errors of 0.0126; of too few scenes for a normal test, too.
TEST(OverScenes, ScenesThatAreNeededDecideInFourCasesOfFive) {
    std::mt19937 random(6);
    for (const double deviation : {0.12, 0.4}) {
        std::normal_distribution<double> logarithm(std::log(1.1), deviation);
        const size_t scenes = size_t(scenes_needed(deviation));
        int decided = 0;
        for (int trial = 0; trial < 1000; ++trial) {
            std::vector<ShotValue> values;
            for (size_t i = 0; i < scenes; ++i) values.push_back({std::to_string(i), logarithm(random)});
            decided += *mean_over_scenes(values).p < 0.05;
        }
        EXPECT_NEAR(decided / 1000.0, 0.8, 4 * 0.0126) << scenes;
    }
    EXPECT_EQ(scenes_needed(0), double(least_scenes));
}

/// 95 % of 1000: 24 or fewer miss in one of 10^4 runs at 0.05, and 79 or more.
TEST(OverScenes, ScenesThatAreNeededHaveTheEndsOfTheDeviation) {
    std::mt19937 random(7);
    std::normal_distribution<double> a(0, 0.3), b(0, 0.4);  // of the difference 0.5
    int missed = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<std::vector<double>> of_points(2, std::vector<double>(12));
        for (double& v : of_points[0]) v = a(random);
        for (double& v : of_points[1]) v = b(random);
        const OverScenes second = compare_over_scenes(shots_of(of_points)).back();
        EXPECT_LE(*second.scenes_needed_low, *second.scenes_needed);
        missed += *second.scenes_needed_low > scenes_needed(0.5) || *second.scenes_needed_high < scenes_needed(0.5);
    }
    EXPECT_GT(missed, 24);
    EXPECT_LT(missed, 79);
}

/// Ranks of the ends as tables have them (Conover, "Practical Nonparametric Statistics", 3.2; coverage 0.969, 0.979,
/// 0.959).
TEST(OverScenes, MediansHaveTheEndsOfOrderStatistics) {
    const std::map<size_t, std::pair<double, double>> ranks = {{6, {1, 6}}, {10, {2, 9}}, {20, {6, 15}}};
    for (const auto& [n, ends] : ranks) {
        std::vector<double> values;
        for (size_t i = n; i > 0; --i) values.push_back(double(i));
        const MedianOverScenes median = median_over_scenes(values);
        EXPECT_EQ(median.value, double(n + 1) / 2);
        EXPECT_EQ(median.low, ends.first) << n;
        EXPECT_EQ(median.high, ends.second) << n;
    }
    const MedianOverScenes of_five = median_over_scenes({5, 1, 4, 2, 3});
    EXPECT_EQ(of_five.value, 3);
    EXPECT_FALSE(of_five.low || of_five.high);
}

TEST(OverScenes, ThreeAssetsHaveNoInterval) {
    const std::vector<ShotValue> values = {{"a", 1}, {"a", 2}, {"b", 3}, {"c", 3}};
    const MeanOverScenes mean = mean_over_scenes(values);
    EXPECT_EQ(mean.scenes, 3u);
    EXPECT_FALSE(mean.low || mean.high || mean.p);
    EXPECT_THROW(mean_over_scenes({}), Error);
}

TEST(OverScenes, RanksHaveTheirRangeWithoutAnyOneScene) {
    const auto found = by_name(compare_over_scenes(shots_of({{0, 0, 0}, {-3, 1, 1}, {9, 9, 9}})));
    const auto ranks = [&](const char* name) {
        const OverScenes& o = found.at(name);
        return std::vector<double>{*o.rank, *o.rank_low, *o.rank_high};
    };
    EXPECT_EQ(ranks("a"), (std::vector<double>{2, 1, 2}));
    EXPECT_EQ(ranks("b"), (std::vector<double>{1, 1, 2}));
    EXPECT_EQ(ranks("c"), (std::vector<double>{3, 3, 3}));
    EXPECT_EQ(found.at("b").standing, "") << "three scenes are too few for a verdict";
}

TEST(OverScenes, RanksOnlyWhatHasNearlyAllShots) {
    std::vector<ShotErrors> shots = shots_of({{2, 2, 2, 2}, {1, 1, 1, 1}});
    shots[3].errors.erase({"b", ""});
    const auto strict = by_name(compare_over_scenes(shots, 0.1)), lenient = by_name(compare_over_scenes(shots, 0.25));
    EXPECT_EQ(strict.at("a").rank, 1);
    EXPECT_FALSE(strict.at("b").rank);
    EXPECT_EQ(strict.at("b").standing, "");
    EXPECT_EQ(lenient.at("b").rank, 1);
    EXPECT_EQ(lenient.at("a").rank, 2);
    EXPECT_EQ(lenient.at("a").shots, 3u) << "ranked over the shots that both have";
}

TEST(OverScenes, ShotsWithoutADivisorCountForNone) {
    std::vector<ShotErrors> shots = shots_of({{1, 1, 1, 1}, {2, 2, 2, 2}});
    shots[2].divisor = std::nullopt;
    const auto found = by_name(compare_over_scenes(shots));
    EXPECT_EQ(found.at("a").scenes, 3u);
    EXPECT_NEAR(found.at("a").ratio, std::exp(1), 1e-12);
}

/// The p of each ratio is Student's of a variance that the mean variance of all pairs moderates with three degrees of
/// freedom; adjusted for the pairs of what remains.
TEST(OverScenes, VerdictsModerateTheScatterOfEachRatio) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    constexpr size_t count = 4, scenes = 6;
    unsigned decided = 0;
    for (unsigned trial = 0; trial < 50; ++trial) {
        std::vector<std::vector<double>> of_points(count, std::vector<double>(scenes));
        for (size_t p = 0; p < count; ++p)
            for (double& v : of_points[p]) v = 0.5 * double(p) + 0.4 * normal(random);
        const std::vector<OverScenes> rows = compare_over_scenes(shots_of(of_points));
        double pooled = 0;
        for (size_t i = 0; i < count; ++i)
            for (size_t k = 0; k < i; ++k) pooled += variance_of(difference(of_points[i], of_points[k])) / 6;
        std::vector<std::pair<double, size_t>> p;
        for (size_t i = 1; i < rows.size(); ++i) {
            const double own = variance_of(difference(rows[i].logarithms[0], rows[0].logarithms[0]));
            const double error = std::sqrt((3 * pooled + 5 * own) / 8 / scenes), value = std::log(*rows[i].over_best);
            p.push_back({2 * student_t_cdf(-std::abs(value) / error, 8), i});
            EXPECT_NEAR(*rows[i].over_best, rows[i].ratio / rows[0].ratio, 1e-12 * *rows[i].over_best);
            EXPECT_NEAR(std::log(*rows[i].over_best_high), value + student_t_quantile(0.975, 8) * error, 1e-9);
        }
        std::ranges::sort(p);
        double adjusted = 0;
        const double pairs[] = {6, 3, 1};
        const auto of_range = [&](size_t step) {  // as the largest difference of those that remain
            const double t = -student_t_quantile(p[step].first / 2, 8);
            return std::min(pairs[step] * p[step].first, studentised_range_tail(t * std::sqrt(2.0), count - step, 8));
        };
        bool is_alone = true;
        for (size_t step = 0; step < p.size(); ++step) {
            const OverScenes& row = rows[p[step].second];
            adjusted = std::min(1.0, std::max(adjusted, of_range(step)));
            EXPECT_NEAR(*row.p_holm, adjusted, 1e-12);
            EXPECT_EQ(row.standing, adjusted < 0.05 ? standing::behind : standing::tied);
            is_alone = is_alone && adjusted < 0.05;
            decided += adjusted < 0.05;
        }
        EXPECT_EQ(rows[0].standing, is_alone ? standing::best : standing::tied);
        EXPECT_FALSE(rows[0].p_holm);
        double sum = 0;
        for (const OverScenes& row : rows) sum += row.chance_first.value();
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_GE(*rows[0].chance_near, *rows[0].chance_first);
    }
    EXPECT_GT(decided, 20u);  // the test sees both verdicts
    EXPECT_LT(decided, 130u);
}

/// Two points that differ by a normal deviate: the posterior is Student's t of n - 2 degrees about the mean difference.
TEST(OverScenes, ChancesOfTwoPointsAreStudents) {
    const std::vector<double> a = {0.1, 0.3, -0.1, 0.5}, b = {0.2, 0.2, 0.3, 0.1};
    const auto found = by_name(compare_over_scenes(shots_of({a, b})));
    const double mean = 0.0, error = std::sqrt(variance_of(difference(a, b)) / 4);
    EXPECT_NEAR(*found.at("a").chance_first, 0.5, 0.02) << "equal means; 6000 draws know 0.5 to 0.0065";
    const double near = student_t_cdf((std::log(1.1) - mean) / error, 2);
    EXPECT_NEAR(*found.at("a").chance_near, near, 0.02);
    EXPECT_FALSE(by_name(compare_over_scenes(shots_of({{1, 2, 3}, {2, 3, 4}}))).at("a").chance_first) << "three scenes";
}

TEST(OverScenes, WhatIsTrulyTheBestIsHardlyEverBehind) {
    std::mt19937 random(5);
    std::student_t_distribution<double> heavy(3);
    const unsigned trials = 2000;
    unsigned behind = 0;
    for (unsigned trial = 0; trial < trials; ++trial) {  // of five points that are equal "a" is as good as any
        std::vector<std::vector<double>> of_points(5, std::vector<double>(8));
        for (auto& point : of_points)
            for (double& v : point) v = heavy(random);
        behind += by_name(compare_over_scenes(shots_of(of_points))).at("a").standing == standing::behind;
    }
    EXPECT_LT(behind, trials * 0.05 + 3 * std::sqrt(trials * 0.05 * 0.95));
}

TEST(OverScenes, DivisorsAreNoNoise) {
    MetricSummary base{.shot = "s", .technique = "none", .point = "default"}, large{.shot = "s", .technique = "x"};
    base.value = 1, base.low = 0.9, base.floor = 0.4, large.value = 100;
    const auto divisor = [&] {
        const MetricSummary* errors[] = {&base, &large};
        return divisor_of(errors, {"none", "default"});
    };
    EXPECT_EQ(divisor()->own, 1);
    base.floor = 0.5;  // not twice what the reference's noise scores
    EXPECT_FALSE(divisor());
    base.floor = 0.4, base.low = 0;
    EXPECT_FALSE(divisor());
    base.low = 0.9, base.value_of_power = 0, base.value_of_bounded = 0.8;  // all of it may be noise
    EXPECT_FALSE(divisor());
    base.value_of_power = 0.7;
    EXPECT_EQ(divisor()->of_power, 0.7);
    large.value = 2e6;
    EXPECT_FALSE(divisor());
}

TEST(OverScenes, TheBaselineIsNoneElseTheStudysFirst) {
    nlohmann::json manifest = {
        {"techniques",
         {{{"technique", "a"}, {"point", "x"}}, {{"technique", "b"}, {"point", "y"}, {"baseline", true}}}}};
    EXPECT_EQ(baseline_over_scenes(manifest), PointName("b", "y"));
    manifest["techniques"].push_back({{"technique", "none"}, {"point", "default"}});
    EXPECT_EQ(baseline_over_scenes(manifest), PointName("none", "default"));
    manifest["techniques"].erase(2), manifest["techniques"].erase(1);
    EXPECT_EQ(baseline_over_scenes(manifest), PointName("a", "x"));
}

TEST(OverScenes, EveryErrorHasItsRows) {
    std::vector<MetricSummary> errors;
    const auto add = [&](const std::string& shot, const std::string& technique, const std::string& metric,
                         double value) {
        MetricSummary e{.shot = shot,
                        .frame = "0",
                        .technique = technique,
                        .point = "default",
                        .target = "specular",
                        .metric = metric,
                        .mask = "all"};
        e.value = value, e.low = 0.9 * value, e.high = 1.1 * value, e.ranked = e.represents_shot = true;
        errors.push_back(e);
    };
    for (const char* shot : {"s", "t", "u", "v"})
        for (const char* metric : {"mse", "ssim"})
            add(shot, "none", metric, 1), add(shot, "half", metric, 0.5), add(shot, "exact", metric, 0.1);
    const nlohmann::json manifest = {
        {"techniques",
         {{{"technique", "none"}, {"point", "default"}},
          {{"technique", "exact"}, {"point", "default"}, {"uses_scene_data", true}}}},
        {"shots", {{{"shot", "u"}, {"asset", "same"}}, {{"shot", "v"}, {"asset", "same"}}}}};
    const std::vector<OverScenesRow> rows = errors_over_scenes(errors, manifest);
    ASSERT_EQ(rows.size(), 2u) << "of mse alone, for which less is better, and without what uses scene data";
    EXPECT_EQ(rows[0].technique, "half");
    EXPECT_EQ(rows[0].metric, "mse");
    EXPECT_EQ(rows[0].scenes, 3u);
    EXPECT_EQ(rows[0].shots, 4u);
    EXPECT_NEAR(rows[0].ratio, 0.5, 1e-12);
    EXPECT_EQ(rows[1].baseline_technique, "none");
    EXPECT_NEAR(*rows[1].over_best, 2, 1e-12);

    // What is compared with a point that differs in a parameter stands behind those, scene data or not.
    std::vector<ComparedPoint> techniques(2);
    techniques[0].technique = techniques[1].technique = "half", techniques[0].point = "default",
    techniques[1].point = "exact";
    techniques[1].against = "p=1", techniques[1].against_point = "default";
    std::vector<MetricSummary> of_pair = errors;
    for (MetricSummary& e : of_pair)
        if (e.technique == "exact") e.technique = "half", e.point = "exact";
    nlohmann::json of_exact = manifest;
    of_exact["techniques"][1]["technique"] = "half", of_exact["techniques"][1]["point"] = "exact";
    const std::vector<OverScenesRow> with_pair = errors_over_scenes(of_pair, of_exact, 0.05, techniques);
    ASSERT_EQ(with_pair.size(), 3u);
    EXPECT_EQ(with_pair[2].point, "exact");
    EXPECT_EQ(with_pair[2].baseline_point, "default");
    EXPECT_NEAR(with_pair[2].ratio, 0.2, 1e-12);
    EXPECT_EQ(with_pair[2].scenes, 3u);
    EXPECT_FALSE(with_pair[2].rank);

    // One seed has no interval in a shot, but counts over scenes, if the reference's noise is no part of its value.
    for (MetricSummary& e : errors)
        if (e.technique == "half")
            e.low = e.high = {}, e.ranked = false, e.interval = interval::one_seed, e.corrected = true;
    EXPECT_EQ(errors_over_scenes(errors, manifest).front().technique, "half");
    for (MetricSummary& e : errors)
        if (e.technique == "half") e.corrected = false;
    EXPECT_EQ(errors_over_scenes(errors, manifest).size(), 1u);
    // Or if it is known how large a part it may be.
    for (MetricSummary& e : errors) {
        e.value_of_power = *e.value - 0.4, e.value_of_bounded = *e.value - 0.1;
        if (e.technique == "exact") e.value_of_power = e.value_of_bounded = e.value;
    }
    nlohmann::json of_four_assets = manifest;
    of_four_assets.erase("shots");
    const OverScenesRow half = errors_over_scenes(errors, of_four_assets).front();
    ASSERT_TRUE(half.low && half.high);
    EXPECT_EQ(half.technique, "half");
    EXPECT_NEAR(half.ratio, 0.5, 1e-12);
    EXPECT_NEAR(*half.low, 0.1 / 0.6, 1e-12);
    EXPECT_NEAR(*half.high, 0.5, 1e-12);
}

/// Measured errors hold noise that grows by one of two laws, and another one in each technique. Without the hull the
/// interval of the mean over 40 scenes holds the truth in none of the trials; with it, in 95 % of 400 at the least: 17
/// misses more than 20 are seen in one of 10^4 runs.
TEST(OverScenes, IntervalsHoldTheRatioWithoutTheReferencesNoise) {
    std::mt19937 random(11);
    std::normal_distribution<double> of_scene(0, 0.5), of_pair(std::log(0.8), 0.1);
    std::uniform_real_distribution<double> noise(0.1, 0.3);
    for (const bool is_of_power : {true, false}) {
        unsigned held = 0, naive = 0;
        for (unsigned trial = 0; trial < 400; ++trial) {
            std::vector<ShotErrors> shots;
            for (unsigned i = 0; i < 40; ++i) {
                const double base = std::exp(of_scene(random)), error = base * std::exp(of_pair(random));
                // a: v^p with p = 0.6; b: -b / (c + v) with c = 4.
                const auto measured = [&](double truth, double grown) {
                    const auto at = [&](double v) {
                        return truth * (1 + grown * (is_of_power ? std::pow(v, 0.6) : 5 * (0.25 - 1 / (4 + v))));
                    };
                    return without_noise(at(1), at(2), at(4));
                };
                const Extrapolated of_base = measured(base, noise(random)),
                                   of_error = measured(error, 3 * noise(random));
                shots.push_back({.asset = std::to_string(i),
                                 .divisor = of_base,
                                 .errors = {{{"a", ""}, of_error}, {{"base", ""}, of_base}}});
            }
            const auto found = by_name(compare_over_scenes(shots));
            const OverScenes& a = found.at("a");
            held += *a.low <= 0.8 && 0.8 <= *a.high;
            std::vector<ShotValue> values;
            for (const double v : a.logarithms.front()) values.push_back({std::to_string(values.size()), v});
            const MeanOverScenes of_measured = mean_over_scenes(values);
            naive += std::exp(*of_measured.low) <= 0.8 && 0.8 <= std::exp(*of_measured.high);
        }
        EXPECT_EQ(naive, 0u) << "else the test sees nothing";
        EXPECT_GE(held, 400u - 37u) << is_of_power;
    }
}

TEST(OverScenes, LawsThatDisagreeDecideNothing) {
    std::vector<ShotErrors> shots = shots_of({{1, 1.01, 0.99, 1}, {0, 0, 0, 0}});
    for (ShotErrors& shot : shots) shot.errors[{"a", ""}].of_power = std::exp(-1);
    const auto found = by_name(compare_over_scenes(shots));
    EXPECT_EQ(found.at("a").p_holm, 1);
    EXPECT_EQ(found.at("a").standing, standing::tied);
    EXPECT_LT(*found.at("a").low, 0.4);
    EXPECT_GT(*found.at("a").high, 2.7);
}
