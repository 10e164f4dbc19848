// What is judged of sequences: flicker and ghosts beside the error, all together.
#include "experiments/results/verdicts/judged_sequences.h"
#include "experiments/results/verdicts/judge_rows.h"
#include "metrics/statistics/quantiles.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

const PointName now = {"frames", "now"}, before = {"frames", "before"};
const PrimaryComparisons primary;
const std::vector<ComparedPoint> compared = {{.technique = "frames", .point = "now"},
                                             {.technique = "frames", .point = "before", .is_baseline = true}};

ResultRow row(const PointName& name, unsigned seed, const std::string& metric, std::optional<double> value) {
    ResultRow r{.shot = "room", .frame = over_frames, .technique = name.first, .point = name.second, .seed = seed};
    r.target = primary.target, r.metric = r.formula = metric, r.mask = primary.mask, r.value = value;
    r.floor = 0, r.represents_shot = true;
    return r;
}

/// Rows of one metric: the values of the seeds of both sides.
std::vector<ResultRow> rows_of_metric(const std::string& metric, const std::vector<double>& of_now,
                                      const std::vector<double>& of_before) {
    std::vector<ResultRow> rows;
    for (unsigned s = 0; s < of_now.size(); ++s) rows.push_back(row(now, s, metric, of_now[s]));
    for (unsigned s = 0; s < of_before.size(); ++s) rows.push_back(row(before, s, metric, of_before[s]));
    return rows;
}

std::vector<Evidence> ghosts(const std::vector<double>& of_now, const std::vector<double>& of_before,
                             double worse_by = 1, const std::vector<ReferenceNoise>& noise = {}) {
    return evidence_of_ghosts(rows_of_metric("ghost_share", of_now, of_before), noise, primary.mask, now, before,
                              {.worse_by = worse_by});
}

ReferenceNoise noise_of(const PointName& name, const std::string& metric, std::vector<float> sums) {
    return {.shot = "room",
            .frame = over_frames,
            .technique = name.first,
            .point = name.second,
            .target = primary.target,
            .metric = metric,
            .mask = primary.mask,
            .sums = std::move(sums)};
}

std::string verdict_on(const std::vector<Evidence>& evidence) { return judge(evidence).verdict; }

std::vector<Evidence> flicker(const std::vector<double>& of_now, const std::vector<double>& of_before,
                              const JudgeLimits& limits = {}) {
    const std::vector<ResultRow> rows = rows_of_metric("frame_difference", of_now, of_before);
    const std::vector<float> sums(noise_groups);
    const std::vector<ReferenceNoise> both = {noise_of(now, "frame_difference", sums),
                                              noise_of(before, "frame_difference", sums)};
    std::vector<EffectRow> effects = paired_effects(rows, compared, {}, both);
    set_verdicts(effects, primary);
    return evidence_of_flicker(effects, rows, primary, now, before, limits);
}

}  // namespace

TEST(JudgedSequences, GhostsAreJudgedByStudentsTestOfTheSeeds) {
    // Differences 0.02, 0.04, 0.06, 0.08: mean 0.05, standard error 0.012910; t = 3.8730 of 3 degrees.
    const Evidence e = ghosts({0.12, 0.14, 0.16, 0.18}, {0.1, 0.1, 0.1, 0.1}).at(0);
    EXPECT_EQ(e.what, judged_number::ghosts);
    EXPECT_NEAR(e.change, 0.05, 1e-12);
    EXPECT_NEAR(e.p_different, 2 * student_t_cdf(-3.8730, 3), 1e-6);
    EXPECT_NEAR(e.high - e.change, 3.18245 * 0.0129099, 1e-6);  // Student's t of 3 degrees at 97.5 %
    // A tolerance of 1.2 allows 1.2 * 0.1: differences 0, 0.02, 0.04, 0.06; t = 2.3238.
    EXPECT_NEAR(ghosts({0.12, 0.14, 0.16, 0.18}, {0.1, 0.1, 0.1, 0.1}, 1.2).at(0).p_different,
                2 * student_t_cdf(-2.3238, 3), 1e-5);
}

TEST(JudgedSequences, AToleranceOfGhostsAllowsAShareOfWhatIsVisible) {
    const std::vector<double> none = {0, 0, 0, 0}, few = {0.009, 0.009, 0.009, 0.009},
                              more = {0.011, 0.011, 0.011, 0.011};
    EXPECT_EQ(verdict_on(ghosts(few, none)), judgement::worse) << "without scatter and tolerance, any increase";
    EXPECT_EQ(verdict_on(ghosts(few, none, 1.2)), judgement::equivalent) << "0.2 of a share of 0.05 is 0.01";
    EXPECT_EQ(verdict_on(ghosts(more, none, 1.2)), judgement::worse);
    EXPECT_EQ(verdict_on(ghosts(none, few)), judgement::better);
}

TEST(JudgedSequences, TheReferencesNoiseIsPartOfGhosts) {
    const std::vector<float> none(noise_groups);
    ReferenceNoise of_now = noise_of(now, "ghost_share", none), of_before = noise_of(before, "ghost_share", none);
    EXPECT_EQ(verdict_on(ghosts({0.12}, {0.1}, 1, {of_now, of_before})), judgement::worse)
        << "no noise is left of the difference";
    for (size_t g = 0; g < noise_groups; ++g) of_now.sums[g] = g % 2 ? 0.0025f : -0.0025f;  // a standard error of 0.04
    EXPECT_EQ(verdict_on(ghosts({0.12}, {0.1}, 1, {of_now, of_before})), judgement::undecided);
    of_before.sums = of_now.sums;
    EXPECT_EQ(verdict_on(ghosts({0.12}, {0.1}, 1, {of_now, of_before})), judgement::worse) << "common noise cancels";
}

TEST(JudgedSequences, AShareBelowZeroIsNoGhost) {
    const std::vector<double> below = {-0.3, -0.3}, none = {0, 0}, above = {0.3, 0.3};
    EXPECT_EQ(verdict_on(ghosts(none, below)), judgement::undecided) << "a repair";
    EXPECT_EQ(verdict_on(ghosts(below, none)), judgement::undecided) << "no ghost was there";
    EXPECT_EQ(verdict_on(ghosts(above, below)), judgement::worse);
    EXPECT_EQ(verdict_on(ghosts(below, above)), judgement::better);
}

TEST(JudgedSequences, ASideWithOneImageHasAllSeeds) {
    // As if each seed were compared with it: the scatter of four images is not lost.
    const std::vector<double> four = {0.1, 0.2, 0.15, 0.25};
    const Evidence one_sided = ghosts(four, {0.1}).at(0), paired = ghosts(four, {0.1, 0.1, 0.1, 0.1}).at(0);
    EXPECT_EQ(one_sided.p_different, paired.p_different);
    EXPECT_GT(one_sided.p_different, 0.01);
    EXPECT_EQ(ghosts({0.1}, four).at(0).p_different, one_sided.p_different);
}

/// Made-up runs with one image a side, which differ by the noise of references of their own alone.
TEST(JudgedSequences, TheReferencesNoiseAloneGivesAsFewAlarms) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    constexpr int runs = 4000;
    int alarms = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<ReferenceNoise> noise;
        double shares[2] = {0.1, 0.1};
        for (const PointName& name : {now, before}) {
            ReferenceNoise& of_side = noise.emplace_back(noise_of(name, "ghost_share", {}));
            for (size_t g = 0; g < noise_groups; ++g) {  // of which the halves' sign is chance
                of_side.sums.push_back(float(0.01 * normal(random)));
                shares[name == before] += (random() & 1 ? 1 : -1) * double(of_side.sums.back());
            }
        }
        const std::string verdict = verdict_on(ghosts({shares[0]}, {shares[1]}, 1, noise));
        alarms += verdict == judgement::worse || verdict == judgement::better;
    }
    // 1 %: 40, and four deviations of a binomial count are 25.
    EXPECT_LE(alarms, 65);
    EXPECT_GE(alarms, 15);
}

TEST(JudgedSequences, VisibilityIsTheDistanceFromTheTruthInJod) {
    // 0.4 JOD from 10, and 0.2 JOD earlier.
    std::vector<ResultRow> rows = rows_of_metric("cvvdp_0_5_6_video", {9.6, 9.6}, {9.8, 9.8});
    for (ResultRow& r : rows) r.target = "image", r.mask = "all";
    const std::vector<float> sums = {0.001f, -0.002f, 0.001f};
    std::vector<ReferenceNoise> both = {noise_of(now, "cvvdp_0_5_6_video", sums),
                                        noise_of(before, "cvvdp_0_5_6_video", sums)};
    for (ReferenceNoise& noise : both) noise.target = "image", noise.mask = "all";
    const auto judged = [&](double worse_by) {
        return evidence_of_visibility(rows, both, now, before, {.worse_by = worse_by});
    };
    ASSERT_EQ(judged(1).size(), 1u);
    EXPECT_EQ(judged(1)[0].what, judged_number::visibility);
    EXPECT_NEAR(judged(1)[0].change, 0.2, 1e-12);
    EXPECT_EQ(verdict_on(judged(1)), judgement::worse) << "common noise cancels";
    EXPECT_EQ(verdict_on(judged(1.7)), judgement::worse) << "1.7 times 0.2 JOD is less than 0.4";
    EXPECT_EQ(verdict_on(judged(2.1)), judgement::equivalent) << "2.1 times 0.2 JOD is more";
    // Noise that the sides do not share: a standard error of 0.05 sqrt(6).
    both[0].sums = {0.05f, -0.1f, 0.05f};
    EXPECT_EQ(verdict_on(judged(1)), judgement::undecided);
    EXPECT_TRUE(evidence_of_visibility(rows, {}, now, before, {}).empty()) << "a truth too noisy for an interval";
}

TEST(JudgedSequences, WhatCannotBeAGhostIsNotJudged) {
    EXPECT_TRUE(evidence_of_ghosts({}, {}, primary.mask, now, before, {}).empty());
    const std::vector<ResultRow> rows = {row(now, 0, "ghost_share", {}), row(before, 0, "ghost_share", {})};
    EXPECT_TRUE(evidence_of_ghosts(rows, {}, primary.mask, now, before, {}).empty())
        << "a change that is lost in noise";
}

TEST(JudgedSequences, FlickerIsARatioAndNeedsNoneWhereOneSideIsStill) {
    EXPECT_TRUE(flicker({0, 0}, {0, 0}).empty());
    EXPECT_EQ(verdict_on(flicker({0.1, 0.1}, {0, 0})), judgement::worse);
    EXPECT_EQ(verdict_on(flicker({0, 0}, {0.1, 0.1})), judgement::better);
    const Evidence e = flicker({0.11, 0.1, 0.12, 0.11}, {0.1, 0.1, 0.11, 0.11}).at(0);
    EXPECT_EQ(e.what, judged_number::flicker);
    EXPECT_NEAR(e.change, 0.44 / 0.42, 1e-12);
    EXPECT_EQ(verdict_on(flicker({0.104, 0.104, 0.104, 0.104}, {0.1, 0.1, 0.1, 0.1})), judgement::worse);
    EXPECT_EQ(verdict_on(flicker({0.104, 0.104, 0.104, 0.104}, {0.1, 0.1, 0.1, 0.1}, {.worse_by = 1.05})),
              judgement::equivalent);
    const std::vector<Evidence> undecided = flicker({-0.01, 0.01}, {0.1, 0.1});
    EXPECT_EQ(verdict_on(undecided), judgement::undecided);
    EXPECT_EQ(undecided.at(0).no_interval, interval::not_positive);
}

/// Made-up runs of a renderer that did not change, with seeds that scatter in all three numbers. With a true rate of 1
/// %, a count of 1500 runs lies at 4 to 26 in all but 1 of 300 cases (three deviations of a binomial count).
TEST(JudgedSequences, AtMostOneRunInAHundredIsCalledWorseOrBetter) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    constexpr int runs = 1500;
    int alarms = 0;
    for (int run = 0; run < runs; ++run) {
        MeasuredRows rows;
        for (const PointName& name : {now, before})
            for (unsigned seed = 0; seed < 4; ++seed) {
                ResultRow error = row(name, seed, primary.metric, std::exp(0.05 * normal(random)));
                ResultRow steps = row(name, seed, "frame_difference", std::exp(0.05 * normal(random)));
                rows.results.push_back(error), rows.results.push_back(steps);
                rows.results.push_back(row(name, seed, "ghost_share", 0.1 + 0.02 * normal(random)));
            }
        for (const PointName& name : {now, before})
            rows.reference_noise.push_back({.shot = "room",
                                            .frame = over_frames,
                                            .technique = name.first,
                                            .point = name.second,
                                            .target = primary.target,
                                            .metric = "frame_difference",
                                            .mask = primary.mask,
                                            .sums = std::vector<float>(noise_groups)});
        const Judgement judged = judge_rows(rows, compared, {}, primary, now, before, {});
        EXPECT_EQ(judged.views.size(), 3u);
        alarms += judged.verdict == judgement::worse || judged.verdict == judgement::better;
    }
    EXPECT_LE(alarms, 26);
    EXPECT_GE(alarms, 4) << "a judge that never alarms sees nothing";
}
