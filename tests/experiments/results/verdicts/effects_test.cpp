// What seeds give: bias and variance, and the effects of points against a baseline.
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/study/measuring/splits.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace {

ResultRow row(const std::string& frame, const std::string& point, unsigned seed, const std::string& metric,
              double value) {
    ResultRow r{.shot = "s",
                .frame = frame,
                .technique = "v",
                .point = point,
                .seed = seed,
                .target = "specular",
                .metric = metric,
                .formula = metric,
                .mask = "all"};
    r.value = value;
    return r;
}

const std::vector<ComparedPoint> two_points = {{.technique = "v", .point = "base", .is_baseline = true},
                                               {.technique = "v", .point = "better"}};

std::vector<EffectRow> effects_of(std::vector<ResultRow> rows, const std::vector<ComparedPoint>& techniques,
                                  const PointSet& not_repeatable = {}) {
    mark_representative_rows(rows);
    return paired_effects(rows, techniques, not_repeatable);
}

}  // namespace

TEST(Effects, AreRatiosPairedBySeed) {
    std::vector<ResultRow> rows;
    // Seeds differ by far more than the points do: only pairs show it.
    const double of_seed[] = {1, 10, 100, 1000};
    for (unsigned seed = 0; seed < 4; ++seed) {
        rows.push_back(row("0", "base", seed, "mse", of_seed[seed]));
        if (seed < 3)
            rows.push_back(row("0", "better", seed, "mse",
                               of_seed[seed] * (seed == 0   ? 0.5
                                                : seed == 1 ? 0.45
                                                            : 0.55)));
        rows.push_back(row("0", "base", seed, "bias", -1)), rows.push_back(row("0", "better", seed, "bias", -1));
    }
    const std::vector<EffectRow> effects = effects_of(rows, two_points);
    ASSERT_EQ(effects.size(), 1u) << "signed biases have no ratio";
    const EffectRow& e = effects.front();
    EXPECT_EQ(e.point, "better");
    EXPECT_EQ(e.against_point, "base");
    EXPECT_EQ(e.seeds, 3u);
    EXPECT_NEAR(*e.ratio, (0.5 * 1 + 0.45 * 10 + 0.55 * 100) / 111, 1e-12);
    EXPECT_LT(*e.high, 1.0);
    EXPECT_GT(*e.low, 0.3);
    EXPECT_LT(*e.p, 0.05);
    EXPECT_EQ(e.interval, interval::seeds) << "no noise of the reference is in these errors";
}

/// Beside the baseline's comparisons, under a name of their own.
TEST(Effects, AreAlsoToldAgainstThePointThatIsOtherwiseTheSame) {
    const std::vector<ComparedPoint> techniques = {
        {.technique = "v", .point = "base", .is_baseline = true},
        {.technique = "v", .point = "plain"},
        {.technique = "v", .point = "changed", .against = "form=x taps=4", .against_point = "plain"}};
    const std::map<std::string, double> errors = {{"base", 8}, {"plain", 2}, {"changed", 1}};
    std::vector<ResultRow> rows;
    for (const auto& [point, error] : errors)
        for (unsigned seed = 0; seed < 3; ++seed)
            rows.push_back(row("0", point, seed, "mse", error * (1 + 0.01 * double(seed * (point == "base" ? 1 : 2)))));
    std::map<std::string, const EffectRow*> found;
    const std::vector<EffectRow> effects = effects_of(rows, techniques);
    for (const EffectRow& e : effects) found[e.point + "/" + e.against + "/" + e.against_point] = &e;
    ASSERT_EQ(effects.size(), 3u);
    ASSERT_EQ(found.size(), 3u);
    ASSERT_TRUE(found.contains("changed/form=x taps=4/plain"));
    const EffectRow& e = *found["changed/form=x taps=4/plain"];
    EXPECT_NEAR(*e.ratio, 0.5, 1e-12);
    EXPECT_TRUE(found.contains("plain/baseline/base") && found.contains("changed/baseline/base"));
}

/// A point that does not depend on its seed is as it is for every seed of the other.
TEST(Effects, CompareWithAPointWithoutSeeds) {
    std::vector<ResultRow> rows = {row("0", "base", 0, "mse", 2)};
    for (unsigned seed = 3; seed < 6; ++seed) rows.push_back(row("0", "better", seed, "mse", 0.9 + 0.1 * (seed - 3)));
    std::vector<ComparedPoint> techniques = two_points;
    EXPECT_EQ(effects_of(rows, techniques).at(0).interval, interval::no_value) << "no seed in common";
    techniques[0].depends_on_seed = false;
    const EffectRow e = effects_of(rows, techniques).at(0);
    EXPECT_EQ(e.seeds, 3u);
    EXPECT_NEAR(*e.ratio, 0.5, 1e-12);
    // Student's interval of the mean of 0.9, 1, 1.1 over 2: 4.303 * 0.1 / sqrt(3) / 2 about 0.5, a little more above
    // than below as the logarithm is what is normal.
    EXPECT_NEAR(*e.high / *e.low, std::exp(2 * 4.3027 * 0.1 / std::sqrt(3.0)), 0.005);
    std::swap(techniques[0].is_baseline, techniques[1].is_baseline);
    EXPECT_NEAR(*effects_of(rows, techniques).at(0).low, 1 / *e.high, 1e-12);
    // Nothing is random but the reference, of which nothing is known.
    rows.back().seed = 0, techniques[1].depends_on_seed = false;
    EXPECT_EQ(effects_of(std::vector{rows.front(), rows.back()}, techniques).at(0).interval,
              interval::unknown_reference);
}

TEST(Effects, PairSeedsByTheirNumber) {
    std::vector<ResultRow> rows;
    for (unsigned seed = 0; seed < 4; ++seed) rows.push_back(row("0", "base", seed, "mse", std::pow(10.0, seed)));
    for (const unsigned seed : {1, 3}) rows.push_back(row("0", "better", seed, "mse", 0.5 * std::pow(10.0, seed)));
    const std::vector<EffectRow> effects = effects_of(rows, two_points);
    ASSERT_EQ(effects.size(), 1u);
    EXPECT_EQ(effects[0].seeds, 2u);
    EXPECT_NEAR(*effects[0].ratio, 0.5, 1e-12) << "rounding of logarithms";
}

TEST(Effects, AreNotJudgedWhereTheReferencesNoiseIsNotKnown) {
    std::vector<ResultRow> rows;
    for (unsigned seed = 0; seed < 4; ++seed)
        for (const char* point : {"base", "better"}) {
            ResultRow r = row("0", point, seed, "flip", (point == std::string("base") ? 1 : 0.5) * (1 + 0.01 * seed));
            r.floor = 0.1;
            rows.push_back(r);
        }
    std::vector<EffectRow> effects = effects_of(rows, two_points);
    ASSERT_EQ(effects.size(), 1u);
    set_verdicts(effects, {});
    EXPECT_EQ(effects[0].interval, interval::unknown_reference);
    EXPECT_FALSE(effects[0].low || effects[0].p) << "another reference may say otherwise, however well the seeds agree";
    EXPECT_EQ(effects[0].verdict, "");
    for (ResultRow& r : rows) r.floor = 0;
    EXPECT_EQ(effects_of(rows, two_points).at(0).interval, interval::seeds) << "an exact reference has no noise";
    for (ResultRow& r : rows) r.metric = "frame_difference", r.floor.reset();
    EXPECT_EQ(effects_of(rows, two_points).at(0).interval, interval::unknown_reference) << "of two references";
    for (ResultRow& r : rows) r.metric = "flicker";
    EXPECT_EQ(effects_of(rows, two_points).at(0).interval, interval::seeds) << "of the point's own frames";
}

TEST(Effects, OnOneErrorAreOneFamily) {
    std::vector<ResultRow> rows;
    // The scatter over three seeds, and so p, is another for each shot and target.
    const std::map<std::pair<std::string, std::string>, double> scatters = {
        {{"a", "specular"}, 1.01}, {{"b", "specular"}, 1.9}, {{"a", "image"}, 1.1}, {{"b", "image"}, 1.4}};
    for (const auto& [key, scatter] : scatters)
        for (unsigned seed = 0; seed < 3; ++seed)
            for (const char* point : {"base", "better"})
                for (const char* metric : {"mse", "relmse"}) {
                    ResultRow r = row("0", point, seed, metric, point == std::string("base") ? 1 : 0.5);
                    if (point == std::string("better")) r.value = *r.value * std::pow(scatter, double(seed) - 1);
                    r.shot = key.first, r.target = key.second, r.floor = 0;
                    rows.push_back(r);
                }
    std::vector<EffectRow> effects = effects_of(rows, two_points);
    ASSERT_EQ(effects.size(), 8u);
    set_verdicts(effects, {.metric = "mse", .mask = "all", .target = "specular"});
    const auto effect_of = [&](const std::string& shot, const std::string& target, const std::string& metric) {
        return *std::ranges::find_if(
            effects, [&](const EffectRow& e) { return e.shot == shot && e.target == target && e.metric == metric; });
    };
    const EffectRow sure = effect_of("a", "specular", "mse"), unsure = effect_of("b", "specular", "mse");
    ASSERT_LT(*sure.p, *unsure.p);
    EXPECT_DOUBLE_EQ(*sure.p_holm, 2 * *sure.p) << "of two, in both shots";
    EXPECT_DOUBLE_EQ(*unsure.p_holm, std::max(*unsure.p, 2 * *sure.p));
    size_t exploratory = 0;
    for (const EffectRow& e : effects) {
        EXPECT_EQ(e.family == "primary", e.target == "specular" && e.metric == "mse");
        EXPECT_EQ(e.p_holm.has_value(), e.p.has_value());
        EXPECT_EQ(e.verdict.empty(), !e.p);
        if (!e.p) continue;
        EXPECT_EQ(e.verdict != verdict::undecided, *e.p_holm < 0.05);
        EXPECT_EQ(*e.low_holm > 1 || *e.high_holm < 1, *e.p_holm < 0.05)
            << "the interval beside a verdict agrees with it";
        EXPECT_LE(*e.low_holm, *e.low * (1 + 1e-12));
        EXPECT_GE(*e.high_holm, *e.high * (1 - 1e-12));
        EXPECT_TRUE(e.p);
        exploratory += e.family == "exploratory";
    }
    EXPECT_EQ(exploratory, 6u);
}

TEST(Effects, OfRowsOverFramesComeBeforeThoseOfOneFrame) {
    // Another ratio in each frame: 1/2 in frame 3, 1/4 in frame 11, 1/8 over all of them.
    std::vector<std::pair<std::string, double>> frames = {{"3", 0.5}, {"11", 0.25}, {over_frames, 0.125}};
    for (const char* order : {"frames first", "all first"}) {
        std::vector<ResultRow> rows;
        for (const auto& [frame, share] : frames)
            for (unsigned seed = 0; seed < 2; ++seed) {
                rows.push_back(row(frame, "base", seed, "mse", 1 + seed));
                rows.push_back(row(frame, "better", seed, "mse", (1 + seed) * share));
                if (frame == over_frames) continue;
                rows.push_back(row(frame, "base", seed, "flip", 1 + seed));
                rows.push_back(row(frame, "better", seed, "flip", (1 + seed) * share));
            }
        const std::vector<EffectRow> effects = effects_of(rows, two_points);
        ASSERT_EQ(effects.size(), 2u);
        for (const EffectRow& e : effects) {
            EXPECT_EQ(e.frame, e.metric == "mse" ? over_frames : "11") << order;
            EXPECT_DOUBLE_EQ(*e.ratio, e.metric == "mse" ? 0.125 : 0.25) << order;
        }
        std::ranges::reverse(frames);
    }
}

TEST(Effects, AreNotMadeUp) {
    // An error that the correction for noise brought to or below 0 has no ratio, and a single seed no interval.
    std::vector<EffectRow> effects =
        effects_of(std::vector{row("0", "base", 0, "mse", 1), row("0", "better", 0, "mse", -1e-9)}, two_points);
    ASSERT_EQ(effects.size(), 1u);
    EXPECT_FALSE(effects[0].ratio);
    effects = effects_of(std::vector{row("0", "base", 0, "mse", 1), row("0", "better", 0, "mse", 0.25)}, two_points);
    EXPECT_EQ(effects[0].ratio, 0.25);
    EXPECT_FALSE(effects[0].low || effects[0].high || effects[0].p || effects[0].p_holm);
    EXPECT_EQ(effects[0].interval, interval::one_seed);
    // Equal errors differ by nothing.
    std::vector<ResultRow> equal;
    for (const char* point : {"base", "better"})
        for (unsigned seed = 0; seed < 2; ++seed) equal.push_back(row("0", point, seed, "mse", 1 + seed));
    effects = effects_of(equal, two_points);
    EXPECT_EQ(effects[0].ratio, 1.0);
    EXPECT_EQ(effects[0].p, 1.0);
    EXPECT_TRUE(effects_of(std::vector{row("0", "other", 0, "mse", 1)}, two_points).empty());
}

TEST(Effects, OfWhatVariesFromRunToRunAreRatiosAlone) {
    std::vector<ResultRow> rows;
    for (unsigned seed = 0; seed < 3; ++seed) {
        rows.push_back(row("0", "base", seed, "mse", 4 + seed));
        rows.push_back(row("0", "better", seed, "mse", 1 + seed));
        rows.push_back(row("0", "third", seed, "mse", 2 + seed));
    }
    std::vector<ComparedPoint> points = two_points;
    points.push_back({.technique = "v", .point = "third"});
    for (const char* varies : {"base", "better"}) {
        const std::vector<EffectRow> effects = effects_of(rows, points, {{"v", varies}});
        ASSERT_EQ(effects.size(), 2u);
        for (const EffectRow& e : effects) {
            EXPECT_LT(e.ratio, 1.0);
            const bool can_tell = e.point == "third" && varies == std::string("better");
            for (const auto& number : {e.low, e.high, e.p})
                EXPECT_EQ(number.has_value(), can_tell) << e.point << " while " << varies << " varies";
            EXPECT_EQ(e.interval, can_tell ? interval::seeds : interval::not_repeatable);
        }
    }
}

TEST(Effects, OfUnboundedErrorsAreThoseOfTheirMeans) {
    // One firefly in eight seeds: most seeds have less error than the baseline, their mean has more.
    std::vector<ResultRow> rows;
    for (unsigned seed = 0; seed < 8; ++seed) {
        rows.push_back(row("0", "base", seed, "mse", 1));
        rows.push_back(row("0", "better", seed, "mse", seed == 5 ? 8 : 0.7));
    }
    const EffectRow e = effects_of(rows, two_points).at(0);
    EXPECT_NEAR(*e.ratio, 12.9 / 8, 1e-12);
    EXPECT_LT(*e.low, 1);
    EXPECT_GT(*e.p, 0.05) << "a single firefly may be chance";
}

/// Light whose noise may be a tenth of one error and none of the other moves that end alone, by as much, and takes an
/// effect of 5 % for nothing. Without it the same errors differ surely.
TEST(Effects, HoldWhatNoisyLightMayHaveAdded) {
    std::map<bool, EffectRow> effects;
    for (const bool is_noisy : {false, true}) {
        std::vector<ResultRow> rows;
        for (unsigned seed = 0; seed < 6; ++seed) {
            const double common = 1 + 0.01 * seed, own = 1 + 0.001 * (seed % 2);
            rows.push_back(row("0", "base", seed, "mse", common));
            rows.push_back(row("0", "better", seed, "mse", 1.05 * own * common));
            if (is_noisy) rows.back().lit_noise = 0.1 * *rows.back().value, rows.back().lit_half_width = 0;
        }
        effects[is_noisy] = effects_of(rows, two_points).at(0);
    }
    const EffectRow &clean = effects[false], &noisy = effects[true];
    EXPECT_EQ(*noisy.ratio, *clean.ratio);
    EXPECT_NEAR(*noisy.low, 0.9 * *clean.low, 1e-9);
    EXPECT_NEAR(*noisy.high, *clean.high, 1e-9);
    EXPECT_LT(*clean.p, 1e-4);
    EXPECT_EQ(*noisy.p, 1.0);
}

/// The light may have added nearly all of an error: of the same pixels it has added the same.
TEST(Effects, OfTheSamePixelsAreOneWhateverTheLight) {
    const auto noise_of = [](const char* point, float scale) {
        ReferenceNoise noise{.shot = "s",
                             .frame = "0",
                             .technique = "v",
                             .point = point,
                             .target = "specular",
                             .metric = "mse",
                             .mask = "all"};
        for (size_t g = 0; g < noise_groups; ++g) noise.sums.push_back(scale * (g % 2 ? 0.01f : -0.01f));
        return noise;
    };
    const auto effect = [&](double error, float noise) {
        std::vector<ResultRow> rows = {row("0", "base", 0, "mse", 1), row("0", "better", 0, "mse", error)};
        for (ResultRow& r : rows) r.lit_noise = 0.9, r.lit_half_width = 0.01, r.floor = 0.1;
        mark_representative_rows(rows);
        std::vector<ComparedPoint> points = two_points;
        for (ComparedPoint& point : points) point.depends_on_seed = false;
        return paired_effects(rows, points, {}, std::vector{noise_of("base", 1), noise_of("better", noise)}).at(0);
    };
    const EffectRow same = effect(1, 1);
    EXPECT_EQ(same.ratio, 1.0);
    EXPECT_EQ(same.low, 1.0);
    EXPECT_EQ(same.high, 1.0);
    EXPECT_LT(*effect(1, 0.5f).low, 0.2) << "equal errors of other pixels may have got more or less of the light";
    EXPECT_LT(*effect(1.1, 1.1f).low, 0.2);
}

/// Intervals of logarithms can have ends beyond all numbers, which no table can hold: they are left out.
TEST(Effects, HaveNoEndsBeyondAllNumbers) {
    constexpr int points = 20;
    for (const double half_width : {600.0, 800.0}) {  // of the logarithm; e^709 is the largest number
        std::vector<ComparedPoint> techniques = {{.technique = "v", .point = "base", .is_baseline = true}};
        std::vector<ResultRow> rows;
        for (unsigned seed = 0; seed < 3; ++seed) rows.push_back(row("0", "base", seed, "mse", 1 + 0.1 * seed));
        for (int i = 0; i < points; ++i) {
            techniques.push_back({.technique = "v", .point = std::to_string(i)});
            for (unsigned seed = 0; seed < 3; ++seed) {
                rows.push_back(row("0", techniques.back().point, seed, "mse", 1 + 0.1 * seed));
                rows.back().lit_noise = 0, rows.back().lit_half_width = half_width * 1.1;  // the mean is 1.1
            }
        }
        std::vector<EffectRow> effects = effects_of(rows, techniques);
        set_verdicts(effects, {.metric = "mse", .mask = "all", .target = "specular"});
        ASSERT_EQ(effects.size(), size_t(points));
        for (const EffectRow& e : effects) {
            EXPECT_FALSE(e.low_holm || e.high_holm) << "the adjusted interval is wider: e^925";
            EXPECT_EQ(e.high.has_value(), half_width < 700);
            if (e.high) {
                EXPECT_NEAR(std::log(*e.high), half_width, 0.01 * half_width) << "the 1.96 of the one and the other";
                EXPECT_EQ(e.verdict, verdict::undecided);
            }
        }
    }
}

TEST(Effects, NeedAValueOfEverySeed) {
    std::vector<ResultRow> rows;
    for (unsigned seed = 0; seed < 3; ++seed)
        for (const char* point : {"base", "better"}) rows.push_back(row("0", point, seed, "mse", 1));
    rows[2].value.reset();
    EXPECT_FALSE(effects_of(rows, two_points).at(0).ratio) << "a missing value is no 0";
    rows[2].value = 0;  // nor is an error of 0 a missing one
    EXPECT_NEAR(*effects_of(rows, two_points).at(0).ratio, 1.5, 1e-12);
}

TEST(Effects, TellBiasFromVariance) {
    // Seeds of a base of bias 1 and standard deviation 0.5; "better" has half the bias, and twice the deviation from
    // seed 2 on. Seeds 0 and 1 are the base's alone.
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    const MetricReference reference = metric_reference(HostImage({64, 64}, 3), {}, {}, {});
    SeedSplit base{reference}, better{reference};
    for (unsigned seed = 0; seed < 8; ++seed) {
        HostImage image({64, 64}, 3), other({64, 64}, 3);
        for (size_t i = 0; i < image.values.size(); ++i) {
            const float noise = normal(random);
            image.values[i] = 1 + 0.5f * noise, other.values[i] = 0.5f + noise;
        }
        base.add(seed, image);
        if (seed > 1) better.add(seed, other);
    }
    std::vector<SplitRow> rows;
    for (const auto& [point, split] : {std::pair("base", &base), std::pair("better", &better)})
        for (SplitRow& r : split_rows(*split, std::vector{full_mask({64, 64})},
                                      {.shot = "s", .frame = "7", .technique = "v", .point = point, .target = "t"}))
            rows.push_back(std::move(r));
    const std::vector<EffectRow> effects = split_effects(rows, two_points);
    ASSERT_EQ(effects.size(), 2u);
    for (const EffectRow& e : effects) {
        const bool is_bias = e.metric == "bias_squared";
        EXPECT_EQ(e.seeds, 6u);
        EXPECT_EQ(e.frame, "7");
        // 12288 values x 6 seeds: the point's bias of 0.5 has a deviation of 0.0037, its square 1.5 %; what it shares
        // with the base makes that less. The noise of both is the same, so that of the variances is 4 but for
        // the rounding of float32.
        EXPECT_NEAR(*e.ratio, is_bias ? 0.25 : 4, is_bias ? 4 * 0.015 * 0.25 : 1e-5) << e.metric;
        EXPECT_LE(*e.low, is_bias ? 0.25 : 4.0001);
        EXPECT_GE(*e.high, is_bias ? 0.25 : 3.9999);
        EXPECT_LT(*e.p, 1e-3);
    }
    for (const EffectRow& e : split_effects(rows, two_points, {{"v", "base"}})) EXPECT_TRUE(e.ratio && !e.low && !e.p);
    rows[0].seed_numbers = {10, 11, 12, 13, 14, 15, 16, 2};
    EXPECT_TRUE(split_effects(rows, two_points).empty()) << "a single seed in common";
}
