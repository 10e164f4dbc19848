// What a study says of a shot at first sight, of made-up tables.
#include "experiments/results/answers/answers.h"

#include "experiments/results/answers/scenes_answer.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"

#include <gtest/gtest.h>

namespace {

using nlohmann::json;

const json manifest = {
    {"primary", {{"metric", "mse"}, {"mask", "reflective"}, {"target", "specular"}}},
    {"clock", {{"aa_floors", {{"s", 0.1}}}, {"proofs", {{{"verdict", "passed"}, {"shots", {"s"}}}}}}},
    {"techniques", {{{"technique", "exact"}, {"point", "default"}, {"uses_scene_data", true}}}},
    {"shots",
     {{{"shot", "s"},
       {"truth_ladder",
        {{{"rung", "camera_radiance"}, {"target", "specular"}, {"metric", "mse"}, {"mask", "reflective"}, {"value", 9}},
         {{"rung", "on_screen"},
          {"target", "specular"},
          {"metric", "mse"},
          {"mask", "reflective"},
          {"value", 0.05},
          {"low", 0.049},
          {"high", 0.051}}}}}}}};

struct Made {
    StudyResults tables;

    /// An error with an interval of -+ `half`, in all else as the headline; a total time unless it is 0.
    void add(const std::string& technique, double value, double half, double milliseconds = 0,
             const std::string& metric = "mse") {
        MetricSummary e{.shot = "s",
                        .frame = "0",
                        .technique = technique,
                        .point = "default",
                        .target = "specular",
                        .metric = metric,
                        .formula = metric,
                        .mask = "reflective"};
        e.value = value, e.low = value - half, e.high = value + half;
        e.ranked = true, e.represents_shot = true;
        e.interval = interval::reference;
        tables.summary.push_back(e);
        if (milliseconds > 0)
            tables.time_summary.push_back({"s", technique, "default", "total", "host_fence", 15, milliseconds,
                                           0.9 * milliseconds, 1.1 * milliseconds});
    }
    ShotAnswer answer(const json& of_study = manifest) {
        set_standings(tables.summary, {}, {{"exact", "default"}});
        set_fronts(tables.summary, tables.time_summary);
        tables.manifest = of_study;
        return shot_answers(tables).at(0);
    }
};

}  // namespace

TEST(Answers, NameTheBestItsGainTheCheaperAndTheLimit) {
    Made made;
    made.add("none", 0.65, 0.001, 0.5);
    made.add("slow", 0.065, 0.005, 10);
    made.add("quick", 0.117, 0.002, 6);
    made.add("beaten", 0.2, 0.002, 8);
    made.add("exact", 0.01, 0.001);
    const ShotAnswer a = made.answer();
    EXPECT_EQ(a.sentence,
              "slow has the least error: mse 0.065 [0.06, 0.07], 0.1x the error without reflections (none). quick "
              "takes 0.6x [0.49x, 0.73x] the time of slow and has 1.8x the error of slow. The lower bound for any "
              "single-frame technique is 0.05 [0.049, 0.051].");
    ASSERT_EQ(a.front.size(), 3u);
    EXPECT_EQ(a.front[1].technique, "quick");
    EXPECT_EQ(a.perceptual_sentence, "");

    json labelled = manifest;
    labelled["techniques"].push_back({{"technique", "slow"}, {"point", "default"}, {"label", "Slow and steady"}});
    EXPECT_TRUE(made.answer(labelled).sentence.starts_with("Slow and steady has the least error"));

    json doubtful = manifest;
    doubtful["clock"]["proofs"][0]["verdict"] = "failed";
    EXPECT_NE(made.answer(doubtful).sentence.find("the time of slow (timer not validated) and has 1.8x"),
              std::string::npos);
    doubtful["clock"]["aa_floors"]["s"] = 0.45;  // 0.6 of the time is then no difference
    EXPECT_EQ(made.answer(doubtful).sentence.find("quick takes"), std::string::npos);
}

TEST(Answers, GiveTheEndsOfNarrowIntervalsAThirdDigit) {
    Made made;
    made.add("slow", 0.065, 0.0001, 10);
    made.add("quick", 0.0806, 0.0001, 6);
    TimeSummary &slow = made.tables.time_summary[0], &quick = made.tables.time_summary[1];
    slow.low = slow.high = 10, quick.low = 5.98, quick.high = 6.02;
    EXPECT_NE(made.answer().sentence.find("takes 0.6x [0.598x, 0.602x] the time of slow"), std::string::npos)
        << made.answer().sentence;
    quick.low = 5.5;
    EXPECT_NE(made.answer().sentence.find("takes 0.6x [0.55x, 0.6x] the time of slow"), std::string::npos)
        << made.answer().sentence;
}

TEST(Answers, RankNothingThatIntervalsCannotTellApart) {
    Made made;
    made.add("a", 0.06, 0.002);
    made.add("b", 0.062, 0.002);
    made.add("c", 0.07, 0.002);
    const ShotAnswer a = made.answer();
    ASSERT_EQ(a.tied.size(), 1u);
    EXPECT_EQ(a.tied[0].technique, "b");
    EXPECT_NE(
        a.sentence.find("a measures the least error: mse 0.06 [0.058, 0.062]. It is undecided whether a errs less "
                        "than b. c certainly has a larger error."),
        std::string::npos)
        << a.sentence;
}

TEST(Answers, MakeNoVerdictOfOnePoint) {
    Made made;
    made.add("none", 0.6, 0.01);
    EXPECT_TRUE(made.answer().sentence.starts_with("none is the only point: mse 0.6")) << made.answer().sentence;
}

TEST(Answers, SayWhatIsRankedAndWhatIsOnlyMeasured) {
    Made made;
    made.add("none", 0.6, 0.01);
    made.add("a", 0.06, 0.002);
    made.add("b", 0.2, 0.002);
    for (size_t i : {1, 2}) {
        MetricSummary& e = made.tables.summary[i];
        e.ranked = false, e.interval = interval::one_seed, e.low = e.high = {};
    }
    const ShotAnswer alone = made.answer();
    EXPECT_EQ(alone.best->technique, "none");
    ASSERT_EQ(alone.unranked.size(), 2u);
    EXPECT_EQ(alone.sentence.find("has the least error"), std::string::npos) << alone.sentence;
    EXPECT_TRUE(
        alone.sentence.starts_with("a measures the least error, mse 0.06, but has no rank. 2 of 3 points have no rank "
                                   "(1 seed). none is the only ranked point: mse 0.6"))
        << alone.sentence;

    made.add("c", 0.1, 0.002);
    EXPECT_TRUE(
        made.answer().sentence.starts_with("a measures the least error, mse 0.06, but has no rank. 2 of 4 points have "
                                           "no rank (1 seed). Among the ranked points, c has the least"))
        << made.answer().sentence;

    for (MetricSummary& e : made.tables.summary) e.ranked = false, e.interval = interval::one_seed;
    EXPECT_FALSE(made.answer().best);
    EXPECT_EQ(
        made.answer().sentence,
        "Nothing is ranked: no mse of this shot has an interval that holds all noise (1 seed). a measures the "
        "least error, mse 0.06. Run with seeds: 4 to rank none, a and 2 more. Add flip to the metrics: flip needs "
        "few samples for an interval.");
}

TEST(Answers, SayWhereALimitOfOneFrameIsReached) {
    Made made;
    made.add("a", 0.0505, 0.001);
    EXPECT_NE(made.answer().sentence.find(
                  "This error reaches the lower bound for any single-frame technique, 0.05 [0.049, 0.051]"),
              std::string::npos)
        << made.answer().sentence;
}

TEST(Answers, TakeALimitInTheNoiseForNone) {
    Made made;
    made.add("a", 0.0505, 0.001);
    json noisy = manifest;
    noisy["shots"][0]["truth_ladder"][1].update({{"value", -1e-7}, {"low", -2e-6}, {"high", 1e-6}});
    EXPECT_NE(made.answer(noisy).sentence.find("single-frame technique is not distinguishable from 0."),
              std::string::npos)
        << made.answer(noisy).sentence;
}

TEST(Answers, SayWhereTheEyeDisagrees) {
    Made made;
    made.add("a", 0.06, 0.001);
    made.add("b", 0.08, 0.001);
    made.add("a", 0.2, 0.01, 0, "flip");
    made.add("b", 0.1, 0.01, 0, "flip");
    EXPECT_NE(made.answer().perceptual_sentence.find(
                  "b (0.1 [0.09, 0.11]) is significantly better than a (0.2 [0.19, 0.21]) in a paired comparison."),
              std::string::npos)
        << made.answer().perceptual_sentence;
    made.tables.summary[3].value = 0.195, made.tables.summary[3].low = 0.185, made.tables.summary[3].high = 0.205;
    EXPECT_NE(made.answer().perceptual_sentence.find("b (0.195 [0.185, 0.205]) measures better than a (0.2 [0.19, "
                                                     "0.21]), but the difference is undecided."),
              std::string::npos);
    made.tables.summary[3].ranked = false;
    EXPECT_NE(made.answer().perceptual_sentence.find("), but not both points are ranked."), std::string::npos)
        << "its noise is not known";
    made.tables.summary[3].ranked = true;
    made.tables.summary[3].value = made.tables.summary[3].low = made.tables.summary[3].high = 0.3;
    EXPECT_NE(made.answer().perceptual_sentence.find("a is the best, too"), std::string::npos);
}

TEST(Answers, SayFirstWhatMayHoldInOtherScenes) {
    Made made;
    made.add("none", 1, 0.1);
    json study = manifest;
    study["techniques"].push_back({{"technique", "a"}, {"point", "default"}, {"label", "A, labelled"}});
    const auto add = [&](const std::string& technique, double rank, const std::string& standing, size_t scenes) {
        OverScenesRow& row = made.tables.over_scenes.emplace_back();
        row.technique = technique, row.point = row.baseline_point = "default", row.baseline_technique = "none";
        row.target = "specular", row.metric = "mse", row.mask = "reflective";
        row.ratio = 0.1 * rank, row.rank = rank, row.standing = standing, row.scenes = scenes;
        if (scenes < least_scenes) return;
        row.low = 0.05 * rank, row.high = 0.2 * rank;
        row.chance_first = std::vector{0.683, 0.301, 0.016}[size_t(rank) - 1];
        row.chance_near = std::vector{0.999, 0.5, 0.25}[size_t(rank) - 1];
    };
    const auto sentence = [&](std::vector<std::string> standings, size_t scenes) {
        made.tables.over_scenes.clear();
        for (size_t i = 0; i < standings.size(); ++i)
            add(std::string(1, char('a' + i)), double(i + 1), standings[i], scenes);
        made.tables.manifest = study;
        return in_scenes_like_these(made.tables);
    };
    EXPECT_EQ(sentence({}, 5), "");
    EXPECT_EQ(sentence({"best", "behind"}, 5),
              "One scene says nothing about other scenes: a verdict over scenes needs at least 4.");
    for (const char* shot : {"t", "u", "v", "w", "x"})
        made.tables.summary.push_back(made.tables.summary.front()), made.tables.summary.back().shot = shot;
    EXPECT_EQ(sentence({"best", "behind", "behind"}, 6),
              "In scenes like these A, labelled certainly has the least error on average: 0.1x [0.05x, 0.2x] the mse "
              "of no reflections (none), geometric mean over 6 scenes.");
    EXPECT_EQ(sentence({"tied", "tied", "behind"}, 5),
              "In scenes like these A, labelled measures the least error on average: 0.1x [0.05x, 0.2x] the mse of no "
              "reflections (none), geometric mean over 5 of 6 scenes. Probability of the least mean error: A, labelled "
              "0.68, b 0.30. Probability of a mean error within 10 % of the least: A, labelled above 0.99, b 0.50, c "
              "0.25. Certainly worse: c.");
    EXPECT_EQ(sentence({"best"}, 6),
              "Nothing is ranked over scenes: A, labelled alone has an error in each of these scenes.")
        << "a study that still runs";
    EXPECT_EQ(sentence({"", ""}, 3),
              "3 scenes say nothing about other scenes: a verdict over scenes needs at least 4. In these scenes A, "
              "labelled has the least error on average.");
}

TEST(Answers, SayWhatIsCertainInTheseScenes) {
    const Headline headline{"mse", "reflective", "specular", ""};
    const auto point = [](const std::string& name) { return AnswerPoint{name, "default", 1, {}, {}}; };
    std::vector<ShotAnswer> answers(3);
    for (size_t i = 0; i < answers.size(); ++i) {
        answers[i].shot = std::string(1, char('p' + i));
        answers[i].best = point(i == 2 ? "b" : "a");
        answers[i].behind = {point("none"), point("c")};
        (i == 1 ? answers[i].near : answers[i].tied).push_back(point(i == 2 ? "a" : "b"));
    }
    EXPECT_EQ(in_these_scenes({answers.front()}, json::object(), headline), "") << "the shot has its own sentence";
    EXPECT_EQ(
        in_these_scenes(answers, json::object(), headline),
        "In these 3 shots these points have the least mse: a in p and q; b in r. Certainly within 5 % of the least: b "
        "in q. Certainly worse in each of these shots: no reflections (none) and c.");
    const json scenes = {{"shots", {{{"shot", "p"}, {"scene", "hall"}}, {{"shot", "q"}, {"scene", "yard"}}}}};
    answers[2].best = {};
    EXPECT_EQ(in_these_scenes(answers, scenes, headline),
              "In 2 of these 3 shots these points have the least mse: a in hall and yard. Certainly within 5 % of the "
              "least: b in yard. Certainly worse in each of these shots: no reflections (none) and c.");
    for (ShotAnswer& a : answers) a.best = {};
    EXPECT_EQ(in_these_scenes(answers, json::object(), headline), "In these 3 shots nothing is ranked by mse.");
}
