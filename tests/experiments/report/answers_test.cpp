// What a study says of a shot at first sight, of made-up tables.
#include "experiments/report/answers.h"

#include <gtest/gtest.h>

namespace {

using nlohmann::json;

const json manifest = {
    {"primary", {{"metric", "mse"}, {"mask", "reflective"}, {"target", "specular"}}},
    {"clock", {{"aa_floor", 0.1}, {"proofs", {{{"verdict", "passed"}, {"shots", {"s"}}}}}}},
    {"variants", {{{"variant", "exact"}, {"point", "default"}, {"asks_scene", true}}}},
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
    ReportTables tables;

    /// An error with an interval of -+ `half`, in all else as the headline; a total time unless it is 0.
    void add(const std::string& variant, double value, double half, double milliseconds = 0,
             const std::string& metric = "mse") {
        MetricSummary e{.shot = "s",
                        .frame = "0",
                        .variant = variant,
                        .point = "default",
                        .target = "specular",
                        .metric = metric,
                        .formula = metric,
                        .mask = "reflective"};
        e.value = value, e.low = value - half, e.high = value + half;
        e.holds_all_noise = metric == "mse", e.speaks_for_shot = true;
        tables.errors.push_back(e);
        if (milliseconds > 0)
            tables.times.push_back({"s", variant, "default", "total", "host_fence", 15, milliseconds,
                                    0.9 * milliseconds, 1.1 * milliseconds});
    }
    ShotAnswer answer(const json& of_study = manifest) const { return shot_answers(tables, of_study).at(0); }
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
    EXPECT_EQ(
        a.sentence,
        "slow has the least error, mse 0.065 [0.06, 0.07] (0.1x that of none); quick takes 0.6x [0.49x, 0.73x] its "
        "time at 1.8x [1.6x, 2x] the error; 0.05 [0.049, 0.051] is left by one that finds all that this one frame "
        "shows.");
    ASSERT_EQ(a.front.size(), 3u);
    EXPECT_EQ(a.front[1].variant, "quick");
    EXPECT_EQ(a.perceptual_sentence, "");

    json labelled = manifest;
    labelled["variants"].push_back({{"variant", "slow"}, {"point", "default"}, {"label", "Slow and steady"}});
    EXPECT_TRUE(made.answer(labelled).sentence.starts_with("Slow and steady has the least error"));

    json doubtful = manifest;
    doubtful["clock"]["proofs"][0]["verdict"] = "failed";
    EXPECT_NE(made.answer(doubtful).sentence.find("its time (by a clock that did not prove itself) at 1.8x"),
              std::string::npos);
    doubtful["clock"]["aa_floor"] = 0.45;  // 0.6 of the time is then no difference
    EXPECT_EQ(made.answer(doubtful).sentence.find("quick takes"), std::string::npos);
}

TEST(Answers, RankNothingThatIntervalsCannotTellApart) {
    Made made;
    made.add("a", 0.06, 0.002);
    made.add("b", 0.063, 0.002);
    made.add("c", 0.07, 0.002);
    const ShotAnswer a = made.answer();
    ASSERT_EQ(a.tied.size(), 1u);
    EXPECT_EQ(a.tied[0].variant, "b");
    EXPECT_NE(a.sentence.find("a has the least error measured, mse 0.06 [0.058, 0.062], but cannot be told from b;"),
              std::string::npos)
        << a.sentence;

    made.tables.errors[0].holds_all_noise = false;  // as of a single seed
    EXPECT_EQ(made.answer().best->variant, "b");
    for (MetricSummary& e : made.tables.errors) e.holds_all_noise = false;
    EXPECT_FALSE(made.answer().best);
    EXPECT_NE(made.answer().sentence.find("nothing is ranked"), std::string::npos);
}

TEST(Answers, SayWhereALimitOfOneFrameIsReached) {
    Made made;
    made.add("a", 0.0505, 0.001);
    EXPECT_NE(made.answer().sentence.find("no more than the 0.05 [0.049, 0.051] that"), std::string::npos)
        << made.answer().sentence;
}

TEST(Answers, TakeALimitInTheNoiseForNone) {
    Made made;
    made.add("a", 0.0505, 0.001);
    json noisy = manifest;
    noisy["shots"][0]["truth_ladder"][1].update({{"value", -1e-7}, {"low", -2e-6}, {"high", 1e-6}});
    EXPECT_NE(made.answer(noisy).sentence.find("leaves no error that can be told from 0."), std::string::npos)
        << made.answer(noisy).sentence;
}

TEST(Answers, SayWhereTheEyeDisagrees) {
    Made made;
    made.add("a", 0.06, 0.001);
    made.add("b", 0.08, 0.001);
    made.add("a", 0.2, 0.01, 0, "flip");
    made.add("b", 0.1, 0.01, 0, "flip");
    EXPECT_NE(made.answer().perceptual_sentence.find("b, 0.1 [0.09, 0.11], is ahead of it at 0.2 [0.19, 0.21]"),
              std::string::npos)
        << made.answer().perceptual_sentence;
    made.tables.errors[3].value = 0.195, made.tables.errors[3].low = 0.185, made.tables.errors[3].high = 0.205;
    EXPECT_NE(made.answer().perceptual_sentence.find("cannot be told from it"), std::string::npos);
    made.tables.errors[3].value = 0.17, made.tables.errors[3].low = made.tables.errors[3].high = {};
    EXPECT_NE(made.answer().perceptual_sentence.find("cannot be told from it"), std::string::npos)
        << "no noise is known";
    for (MetricSummary& e : made.tables.errors) e.floor = 0.02;
    EXPECT_NE(made.answer().perceptual_sentence.find("b, 0.17, is ahead of it"), std::string::npos);
    for (MetricSummary& e : made.tables.errors) e.floor = 0.04;
    EXPECT_NE(made.answer().perceptual_sentence.find("cannot be told from it"), std::string::npos);
    made.tables.errors[3].value = 0.3;
    EXPECT_NE(made.answer().perceptual_sentence.find("it leads, too"), std::string::npos);
}
