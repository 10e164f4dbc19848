// What is best, tied or behind: made-up errors, and simulated seeds of heavy-tailed noise.
#include "experiments/results/verdicts/standings.h"

#include "experiments/results/verdicts/interval.h"

#include <gtest/gtest.h>
#include <random>

namespace {

MetricSummary error_of(const std::string& technique, double value, double half, const std::string& metric = "mse") {
    MetricSummary e{.shot = "s",
                    .frame = "0",
                    .technique = technique,
                    .point = "default",
                    .target = "specular",
                    .metric = metric,
                    .formula = metric,
                    .mask = "reflective"};
    e.value = value, e.low = value - half, e.high = value + half;
    e.interval = interval::reference, e.seeds = 1;
    e.ranked = e.represents_shot = true;
    return e;
}

std::vector<std::string> standings(std::vector<MetricSummary> errors, const PointSet& without_part = {}) {
    set_standings(errors, {}, without_part);
    std::vector<std::string> found;
    for (const MetricSummary& e : errors) found.push_back(e.standing);
    return found;
}
using Standings = std::vector<std::string>;

}  // namespace

TEST(Standings, SeparateWhatIsSignificantlyWorse) {
    EXPECT_EQ(standings({error_of("a", 1, 0.1), error_of("b", 2, 0.1), error_of("c", 3, 0.1)}),
              (Standings{"best", "behind", "behind"}));
    EXPECT_EQ(standings({error_of("a", 1, 0.1), error_of("b", 1.1, 0.1), error_of("c", 3, 0.1)}),
              (Standings{"tied", "tied", "behind"}));
    EXPECT_EQ(standings({error_of("a", 1, 0.1), error_of("a2", 1, 0.1)}), (Standings{"tied", "tied"}));
}

TEST(Standings, FollowTheDirectionOfTheMetric) {
    for (const char* metric : {"ssim", "psnr"})
        EXPECT_EQ(standings({error_of("a", 0.5, 0.01, metric), error_of("b", 0.9, 0.01, metric)}),
                  (Standings{"behind", "best"}))
            << metric;
    EXPECT_EQ(standings({error_of("a", -0.5, 0.01, "bias"), error_of("b", 0.1, 0.01, "bias")}),
              (Standings{"behind", "best"}));
    EXPECT_EQ(standings({error_of("a", 0.2, 0.01, "energy_ratio"), error_of("b", 1.1, 0.01, "energy_ratio")}),
              (Standings{"behind", "best"}));
}

TEST(Standings, RankOnlyWhatHasAnIntervalOfAllNoise) {
    std::vector<MetricSummary> errors = {error_of("a", 1, 0.1), error_of("b", 2, 0.1), error_of("c", 0.1, 0.01)};
    errors[2].ranked = false;
    EXPECT_EQ(standings(errors), (Standings{"best", "behind", ""}));
    errors[1].ranked = false;
    EXPECT_EQ(standings(errors), (Standings{"", "", ""})) << "one alone is the best of nothing";
    EXPECT_EQ(standings({error_of("a", 1, 0.1), error_of("b", 2, 0.1), error_of("exact_scene", 0.1, 0.01)},
                        {{"exact_scene", "default"}}),
              (Standings{"best", "behind", ""}));
}

TEST(Standings, AdjustForTheNumberOfPoints) {
    // 2.2 standard errors of the difference apart: p = 0.028 of a single comparison.
    const double half = 1.96 * 0.1, apart = 2.2 * 0.1 * std::sqrt(2.0);
    std::vector<MetricSummary> errors = {error_of("a", 2, half), error_of("b", 2 + apart, half)};
    EXPECT_EQ(standings(errors), (Standings{"best", "behind"}));
    for (int i = 0; i < 8; ++i) errors.push_back(error_of("c" + std::to_string(i), 2 + apart, half));
    EXPECT_EQ(standings(errors).front(), "tied");
}

TEST(Standings, PairBySeedWherePairsHoldAllNoise) {
    // Each scatters by a third of itself from seed to seed, in common; a is always 5 % below b.
    std::vector<ResultRow> rows;
    const double scatter[] = {1.0, 1.6, 0.7, 1.2};
    for (unsigned seed = 1; seed <= 4; ++seed)
        for (const auto& [technique, value] : {std::pair("a", 1.0), std::pair("b", 1.05)}) {
            ResultRow r{.shot = "s", .frame = "0", .technique = technique, .point = "default", .seed = seed};
            r.target = "specular", r.metric = r.formula = "mse", r.mask = "reflective", r.floor = 0;
            r.value = value * scatter[seed - 1] * (1 + 0.001 * double(seed)), r.represents_shot = true;
            rows.push_back(r);
        }
    std::vector<MetricSummary> errors = summarise(rows);
    set_standings(errors, paired_errors(rows, {}));
    EXPECT_EQ(errors[0].standing, "best");
    EXPECT_EQ(errors[1].standing, "behind");
    EXPECT_NEAR(errors[1].over_best.value(), 1.05, 1e-9);
    set_standings(errors);
    EXPECT_EQ(errors[0].standing, "tied") << "their intervals overlap by far";
}

/// Points of nearly equal true errors: the one that is truly best must not be called behind. Log-normal seeds of
/// deviation 1 have single values of ten times the median, as fireflies make them.
TEST(Standings, KeepTheTrueBestAmongBestAndTiedOnHeavyTails) {
    std::mt19937 random(7);
    for (const unsigned seeds : {4u, 8u}) {
        constexpr int studies = 2000, points = 8;
        int lost = 0;
        for (int study = 0; study < studies; ++study) {
            std::vector<ResultRow> rows;
            for (unsigned seed = 1; seed <= seeds; ++seed)
                for (int p = 0; p < points; ++p) {
                    ResultRow r{.shot = "s", .frame = "0", .technique = std::to_string(p), .point = "", .seed = seed};
                    r.target = "specular", r.metric = r.formula = "mse", r.mask = "reflective", r.floor = 0;
                    const double truth = p == 0 ? 1 : 1.02;
                    r.value = truth * std::exp(std::normal_distribution<double>(-0.5, 1)(random));
                    r.represents_shot = true;
                    rows.push_back(r);
                }
            std::vector<MetricSummary> errors = summarise(rows);
            set_standings(errors, paired_errors(rows, {}));
            lost += errors.front().standing == standing::behind;
        }
        // Measured: 2.3 and 3.4 %. At most 5 %: 2000 studies of exactly that exceed 6.7 % with a probability of 0.0003.
        EXPECT_LT(double(lost) / studies, 0.067) << seeds << " seeds";
    }
}

TEST(Standings, CallWhatIsWithinTheMarginEquivalent) {
    // b errs 1 % more, with a standard error of 0.7 % of the difference: not behind, and 5 standard errors within 5 %.
    EXPECT_EQ(standings({error_of("a", 1, 0.01), error_of("b", 1.01, 0.01), error_of("c", 3, 0.1)}),
              (Standings{"tied", "equivalent", "behind"}));
    EXPECT_EQ(standings({error_of("a", 1, 0.05), error_of("b", 1.01, 0.05)}), (Standings{"tied", "tied"}))
        << "too uncertain";
    std::vector<MetricSummary> errors = {error_of("a", 1, 0.001), error_of("b", 1.02, 0.001)};
    set_standings(errors);
    EXPECT_EQ(errors[1].standing, standing::behind);
    EXPECT_LT(*errors[1].p_equivalent, 1e-6) << "behind by less than the margin: both are certain";
    set_standings(errors, {}, {}, 0.01);
    EXPECT_GT(*errors[1].p_equivalent, 0.99);
    errors = {error_of("a", 0.9, 0.001, "ssim"), error_of("b", 0.899, 0.001, "ssim")};
    set_standings(errors);
    EXPECT_GT(*errors[1].p_equivalent, 0.05) << "of what is lacking to 1, 0.001 of 0.1 with 0.0014 of 0.005";
}

/// In studies without any difference at most one in twenty may name a point that is behind, in whichever shot, or an
/// effect; and of points that err just the margin more than the first as many may be called equivalent.
TEST(Standings, AreWrongInAtMostOneStudyOfTwenty) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    constexpr int studies = 400, shots = 4, points = 8;
    int behind = 0, effects_found = 0, equivalent = 0;
    for (const bool is_at_margin : {false, true})
        for (int study = 0; study < studies; ++study) {
            std::vector<ResultRow> rows;
            std::vector<ComparedPoint> techniques;
            for (int p = 0; p < points; ++p)
                techniques.push_back({.technique = std::to_string(p), .point = "", .is_baseline = p == 0});
            for (int shot = 0; shot < shots; ++shot)
                for (unsigned seed = 1; seed <= 4; ++seed)
                    for (int p = 0; p < points; ++p) {
                        ResultRow r{.shot = std::to_string(shot), .frame = "0", .technique = std::to_string(p)};
                        r.target = "specular", r.metric = r.formula = "mse", r.mask = "reflective", r.floor = 0;
                        r.seed = seed, r.represents_shot = true;
                        r.value = (is_at_margin && p > 0 ? 1.05 : 1.0) * std::exp(0.02 * normal(random));
                        rows.push_back(r);
                    }
            std::vector<MetricSummary> errors = summarise(rows);
            std::vector<EffectRow> effects = paired_effects(rows, techniques);
            const PrimaryComparisons primary{.metric = "mse"};
            set_standings(errors, paired_errors(rows, techniques));
            set_verdicts(effects, primary, decided_by_standings(errors));
            match_effects(errors, effects);
            const auto is_significant = [](const EffectRow& e) {
                return e.verdict == verdict::less || e.verdict == verdict::more;
            };
            const auto is_wrongly_near = [](const MetricSummary& e) {
                return e.technique != "0" && e.p_equivalent.value_or(1) < significance;
            };
            if (is_at_margin) {
                equivalent += std::ranges::any_of(errors, is_wrongly_near);
            } else {
                behind += std::ranges::count(errors, standing::behind, &MetricSummary::standing) > 0;
                effects_found += std::ranges::any_of(effects, is_significant);
            }
        }
    // At most 5 %: 400 studies of exactly that exceed 8.5 % with a probability of 0.001.
    EXPECT_LT(behind, 0.085 * studies);
    EXPECT_LT(effects_found, 0.085 * studies);
    EXPECT_LT(equivalent, 0.085 * studies);
}

/// Of a pair that both compare the larger p counts, whichever way round the study asked for it.
TEST(Standings, AgreeWithTheirPairsAmongEffects) {
    std::vector<MetricSummary> errors = {error_of("a", 1, 0.1), error_of("b", 2, 0.1), error_of("c", 3, 0.1)};
    set_standings(errors);
    ASSERT_EQ(errors[1].standing, standing::behind);
    const auto effect = [](const std::string& technique, const std::string& against) {
        EffectRow e{.shot = "s", .technique = technique, .point = "default", .against_technique = against};
        e.against_point = "default", e.target = "specular", e.metric = "mse", e.mask = "reflective";
        e.ratio = 1.5, e.low = 1.4, e.high = 1.6, e.p = 0.001;
        e.estimate = {.value = 1.5, .standard_error = 0.03, .degrees = 7};
        return e;
    };
    std::vector<EffectRow> effects = {effect("b", "a"), effect("a", "b"), effect("c", "b")};
    effects[1].ratio = 0.5;
    set_verdicts(effects, {}, decided_by_standings(errors));
    match_effects(errors, effects);
    EXPECT_EQ(effects[0].verdict, verdict::more);
    EXPECT_EQ(effects[1].verdict, verdict::less);
    EXPECT_EQ(effects[0].p_holm, errors[1].p_best);
    EXPECT_EQ(errors[1].standing, standing::behind);

    // Of twenty comparisons with p = 0.01 none is significant (Holm), and so b is not behind.
    for (EffectRow& e : effects) e.p = 0.01;
    for (int i = 0; i < 17; ++i) effects.push_back(effect("other" + std::to_string(i), "a")), effects.back().p = 0.01;
    set_verdicts(effects, {}, decided_by_standings(errors));
    match_effects(errors, effects);
    EXPECT_EQ(effects[0].verdict, verdict::undecided);
    EXPECT_EQ(errors[1].standing, standing::tied);
    EXPECT_EQ(errors[2].standing, standing::behind) << "the study compares it with another point";
    EXPECT_EQ(errors[0].standing, standing::tied);

    // The standing's p is the larger one: the interval is at its level, and holds 1.
    set_standings(errors);
    errors[1].p_best = 0.5;
    effects.resize(1), effects[0].p = 0.001;
    set_verdicts(effects, {}, decided_by_standings(errors));
    EXPECT_EQ(effects[0].verdict, verdict::undecided);
    EXPECT_LT(*effects[0].low_holm, *effects[0].low);
}

TEST(Fronts, HoldWhatNoRankedPointBeatsAtLess) {
    std::vector<MetricSummary> errors = {error_of("a", 3, 0.1), error_of("b", 2, 0.1), error_of("c", 1, 0.1),
                                         error_of("single_seed", 0.1, 0.01)};
    errors[3].ranked = false;
    set_standings(errors);
    std::vector<TimeSummary> times;
    std::vector<CostRow> costs;
    for (const auto& [technique, ms, fetches, read, written] : {std::tuple("a", 5.0, 30u, 10u, 1u),
                                                                {"b", 1.0, 20u, 2u, 7u},
                                                                {"c", 4.0, 20u, 1u, 9u},
                                                                {"single_seed", 0.1, 1u, 1u, 1u}}) {
        TimeSummary t;
        t.shot = "s", t.technique = technique, t.point = "default", t.stage = "total", t.median = ms;
        times.push_back(t);
        for (const auto& [quantity, count] :
             {std::pair("fetches", fetches), {"bytes_read", read}, {"bytes_written", written}})
            costs.push_back({"s", technique, "default", "total", quantity, count});
    }
    std::vector<EstimateRow> estimates;
    for (const auto& [technique, stage, us] : {std::tuple("a", "total", std::optional(1.0)),
                                               {"b", "total", 9.0},
                                               {"b", "march", 0.1},
                                               {"c", "total", 2.0}}) {
        EstimateRow e;
        e.shot = "s", e.technique = technique, e.point = "default", e.stage = stage, e.chip = "navi21",
        e.microseconds = us;
        estimates.push_back(e);
        e.chip = "vega20", e.microseconds = {}, e.refusal = "no rates";
        estimates.push_back(e);
    }
    set_fronts(errors, times, costs, estimates);
    std::vector<std::string> fronts;
    for (const MetricSummary& e : errors) fronts.push_back(e.fronts);
    EXPECT_EQ(fronts, (std::vector<std::string>{"navi21", "time bytes", "time fetches bytes navi21", ""}));
    EXPECT_TRUE(is_on_front(errors[1], front::bytes));
    EXPECT_FALSE(is_on_front(errors[1], "fetches"));
}
