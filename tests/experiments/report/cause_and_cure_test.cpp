// What is said of points that are not ranked, and of what a study can see, of made-up errors.
#include "experiments/results/answers/cause_and_cure.h"

#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

using nlohmann::json;

/// The errors of one shot with a reference of 64 samples, whose noise lies on its mirrors.
struct MadeShot {
    std::vector<MetricSummary> errors;
    json reference = {{"samples_median", 64},
                      {"noise",
                       {{"noisiest_share", 0.8437},
                        {"by_roughness",
                         {{{"from", 0}, {"below", 0.1}, {"variance_share", 0.92}},
                          {{"from", 0.1}, {"below", 0.3}, {"variance_share", 0.08}}}}}}};
    PointLabels labels = {{{"b", "default"}, "Bee"}};

    /// A point without an interval, as `interval` says; "": ranked.
    MetricSummary& add(const std::string& technique, const std::string& interval, const std::string& metric = "mse") {
        MetricSummary e{.shot = "s", .frame = "0", .technique = technique, .point = "default"};
        e.metric = metric, e.mask = "reflective", e.value = 1, e.floor = 0.1, e.pixels = 5000, e.seeds = 4;
        e.interval = interval;
        if (interval.empty()) {
            e.interval = interval::reference_and_seeds, e.ranked = true, e.low = 0.9, e.high = 1.1;
            e.standing = standing::tied;
        }
        return errors.emplace_back(e);
    }
    JudgedShot judged(size_t comparisons = 1) {
        pointers.clear();
        for (const MetricSummary& e : errors) pointers.push_back(&e);
        return {pointers, "mse", reference, labels, comparisons};
    }
    std::string cure() { return cure_sentences(judged()); }

private:
    std::vector<const MetricSummary*> pointers;
};

}  // namespace

TEST(CauseAndCure, NamesThePixelsTheSamplesAndTheMetricThatDecides) {
    MadeShot made;
    made.add("a", interval::few_paths), made.add("b", interval::few_paths);
    EXPECT_EQ(made.cure(),
              " 1 % of the pixels hold 84 % of the reference's noise. Surfaces of roughness 0 to 0.1 hold 92 % of this "
              "noise. About 128 samples per pixel (reference.samples) would give mse intervals. This reference has 64 "
              "samples per pixel. Add flip to the metrics: flip needs few samples for an interval.");
    EXPECT_EQ(samples_needed(60), 128) << "references have 16 x 2^k";
    for (const char* technique : {"a", "b"}) made.add(technique, "", "flip");
    made.add("a", "", "ssim");
    EXPECT_TRUE(made.cure().ends_with(" flip already ranks all 2 points.")) << made.cure();
    made.reference = json();  // a folder of another version
    EXPECT_EQ(made.cure(), " flip already ranks all 2 points.");
}

TEST(CauseAndCure, TellsSeedsFromRunsAndFromMissingHalves) {
    MadeShot made;
    made.add("a", interval::one_seed), made.add("b", interval::one_seed), made.add("c", interval::one_seed);
    made.add("d", ""), made.add("d", "", "flip");
    EXPECT_EQ(made.cure(), " Run with seeds: 4 to rank a, Bee and 1 more.") << "flip ranks no more than mse does";

    MadeShot runs;
    MetricSummary& e = runs.add("a", "");
    e.ranked = false, e.standing.clear();
    runs.add("a", "", "flip"), runs.add("b", "", "flip");
    EXPECT_EQ(runs.cure(),
              " No number of seeds ranks a, because results differ from run to run. flip already ranks all 2 points.");

    MadeShot foreign;
    foreign.add("a", interval::unknown_reference).floor = std::nullopt;
    EXPECT_TRUE(foreign.cure().starts_with(" This shot's reference came without halves")) << foreign.cure();

    MadeShot ranked;
    ranked.add("a", ""), ranked.add("b", "");
    EXPECT_EQ(ranked.cure(), "");
}

TEST(CauseAndCure, CountsThePixelsOfASmallMask) {
    MadeShot made;
    made.add("a", interval::few_paths).pixels = 3;
    EXPECT_NE(
        made.cure().find(" The mask reflective holds only 3 pixels. About 2048 samples per pixel (reference.samples) "
                         "would give mse an interval. This reference has 64 samples per pixel."),
        std::string::npos)
        << made.cure() << ": 4096 samples of 3 pixels are 1366 each";
}

TEST(CauseAndCure, SaysWhichDifferencesAreSeen) {
    MadeShot made;
    const auto pair = [&](const std::string& technique, double half) {
        MetricSummary& e = made.add(technique, "");
        e.interval = interval::reference, e.seeds = 1;
        e.over_best_low = 1.5 * std::exp(-half), e.over_best_high = 1.5 * std::exp(half);
    };
    made.add("best", "");
    pair("a", 0.02), pair("c", 0.02);
    // Two comparisons: (2.241 + 0.842) / 1.960 half-widths, 3.2 %.
    EXPECT_EQ(power_sentence(made.judged(2)),
              " A study like this detects a difference of 3.2 % from the best in 8 of 10 cases.");
    pair("b", 0.2);
    EXPECT_EQ(
        power_sentence(made.judged(3)),
        " A study like this detects a difference of 3.4 % from the best in 8 of 10 cases. For Bee this difference "
        "is 39 %.");
    MadeShot single;
    single.add("best", "");
    EXPECT_EQ(power_sentence(single.judged()), "");
    MetricSummary& noisy = single.add("a", "");
    noisy.interval = interval::reference, noisy.seeds = 1;
    noisy.over_best_low = std::exp(-100), noisy.over_best_high = std::exp(100);
    EXPECT_EQ(power_sentence(single.judged()),
              " A study like this detects a difference of more than 1000 % from the best in 8 of 10 cases.");

    OverScenesRow first, row;
    first.scenes = row.scenes = 11, first.rank = 1, row.rank = 2;
    row.over_best_low = 0.8, row.over_best_high = 1.25;
    const std::vector<const OverScenesRow*> rows = {&first, &row};
    EXPECT_EQ(power_over_scenes_sentence(rows),
              " A study like this detects a difference of 36 % in 8 of 10 cases. Detecting 10 % takes 95 scenes.");
    EXPECT_EQ(power_over_scenes_sentence(std::span(rows).first(1)), "");

    OverScenesRow unranked, other;
    unranked.metric = "mse", other.metric = "flip", other.rank = 1;
    EXPECT_EQ(deciding_over_scenes_sentence(std::vector{unranked, other}, unranked),
              " flip ranks points over scenes (over_scenes.csv).");
    other.mask = "edge";
    EXPECT_EQ(deciding_over_scenes_sentence(std::vector{unranked, other}, unranked), "");
}
