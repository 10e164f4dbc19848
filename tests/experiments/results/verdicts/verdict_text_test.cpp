// What `ssrlab judge` says: the same for terminal, page and verdict.json.
#include "experiments/results/verdicts/verdict_text.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

namespace fs = std::filesystem;

Evidence evidence(const std::string& shot, const char* what, double change, double p) {
    return {.shot = shot,
            .what = what,
            .change = change,
            .low = 0.9 * change,
            .high = 1.1 * change,
            .no_change = what == std::string(judged_number::ghosts) || what == std::string(judged_number::visibility)
                             ? 0.0
                             : 1.0,
            .p_different = p,
            .detectable = 1.02};
}

struct Folder {
    fs::path path = fs::temp_directory_path() / "verdict_text_test";
    Folder() { fs::remove_all(path), fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST(VerdictText, NamesWhatGotWorseAndWhereFirst) {
    const Judgement judged =
        judge({evidence("a", judged_number::error, 1.1, 0.5), evidence("b", judged_number::error, 1.3, 1e-6),
               evidence("a", judged_number::ghosts, 0.2, 1e-9)});
    const VerdictText text = verdict_text(judged, {}, {.worse_by = 1.05}, "before");
    EXPECT_EQ(text.headline, "worse against before: error in b; ghosts in a");
    EXPECT_EQ(text.rules[0],
              "An error of these frames is worse if it is certainly more than 1.05 times that of the earlier frames.");
    EXPECT_EQ(text.rules[1], "An error is equivalent if it certainly changed by less than 5 %.");
    EXPECT_EQ(
        text.rules[2],
        "A share of ghosts is worse if it certainly rose by more than 0.05 times the earlier share, or times 0.05 "
        "if that is more. It is equivalent if it certainly changed by less than 0.05 or than that.");
    ASSERT_EQ(text.numbers.size(), 3u);
    EXPECT_EQ(
        text.numbers[0],
        "a: ghosts (ghost_share) 0.2 [0.18, 0.22] more than in before: worse (p 3e-09; 1.02 more would be seen in "
        "95 % of runs)");
    EXPECT_EQ(
        text.numbers[1],
        "b: error (mse) 1.3 [1.17, 1.43] times that of before: worse (p 2e-06; 1.02 times would be seen in 95 % of "
        "runs)");
    EXPECT_EQ(text.deciding, 2u);
    EXPECT_EQ(text.lead().back(), "verdict.json holds all 3 numbers.");
}

TEST(VerdictText, NamesTheLightWhereItsNoiseHidesTheChange) {
    Evidence hidden = evidence("a", judged_number::error, 5.6, 0.06);
    hidden.of_light = 28;
    const auto sentence = [](const Evidence& of) { return verdict_text(judge({of}), {}, {}, "before").numbers.at(0); };
    EXPECT_EQ(
        sentence(hidden),
        "a: error (mse) 5.6 [5.04, 6.16] times that of before: undecided (p 0.06; 1.02 times would be seen in 95 % "
        "of runs). The noise of the light in these frames widens the interval by a factor of up to 28. Add half "
        "images, or make the light with more `scene-for --samples`");
    hidden.p_different = 1e-9;
    EXPECT_EQ(sentence(hidden).find("light"), std::string::npos) << "it hides nothing";
    Evidence same = evidence("a", judged_number::error, 1, 1);
    same.low = same.high = 1, same.p_equivalent = 0;
    EXPECT_EQ(sentence(same), "a: error (mse) 1 [1, 1] times that of before: equivalent");
}

TEST(VerdictText, NamesVisibilityInJod) {
    const Judgement judged =
        judge({evidence("a", judged_number::error, 1, 0.5), evidence("a", judged_number::visibility, 0.2, 1e-9)});
    const VerdictText text = verdict_text(judged, {}, {}, "before");
    EXPECT_EQ(text.headline, "worse against before: visibility in a");
    EXPECT_EQ(text.rules[2],
              "Visibility is worse if the distance from the truth, 10 less cvvdp_0_5_6_video, certainly rose. It is "
              "equivalent if it certainly changed by less than 0.1 JOD.");
    EXPECT_EQ(text.numbers[0],
              "a: visibility (cvvdp_0_5_6_video) 0.2 [0.18, 0.22] JOD further from the truth than in before: worse (p "
              "2e-09; 1.02 JOD further from the truth would be seen in 95 % of runs)");
}

TEST(VerdictText, SaysWhyANumberIsNotDecided) {
    Evidence lost = evidence("a", judged_number::flicker, 1, 1);
    lost.no_interval = "none: an error is not above 0";
    Evidence sudden = evidence("b", judged_number::flicker, INFINITY, 0);
    sudden.no_interval = "the earlier frames have none";
    const VerdictText text = verdict_text(judge({lost, sudden}), {}, {}, "before");
    EXPECT_EQ(text.numbers[0], "b: flicker (frame_difference) worse, the earlier frames have none");
    EXPECT_EQ(text.numbers[1], "a: flicker (frame_difference) undecided, none: an error is not above 0");
    EXPECT_EQ(text.rules[0],
              "Error or flicker of these frames is worse if it is certainly more than that of the earlier frames.");
}

TEST(VerdictText, IsKeptInAFileForThePage) {
    const Folder folder;
    EXPECT_FALSE(read_verdict(folder.path));
    const Judgement judged = judge({evidence("a", judged_number::error, 1.3, 1e-6)});
    const JudgeLimits limits{.worse_by = 1.2};
    const VerdictText text = verdict_text(judged, {}, limits, "before");
    write_verdict(folder.path, text, &judged, limits);
    EXPECT_EQ(read_verdict(folder.path)->headline, text.headline);
    EXPECT_EQ(read_verdict(folder.path)->sentences, text.lead());
    const nlohmann::json file = read_json(folder.path / "verdict.json");
    EXPECT_EQ(file["worse_by"], 1.2);
    EXPECT_EQ(file["false_alarms"], 0.01);
    EXPECT_EQ(file["numbers"][0]["change"], 1.3);
    remove_verdict(folder.path);
    EXPECT_FALSE(read_verdict(folder.path));
    for (const char* broken : {"{", "[]", R"({"headline": 1, "sentences": []})", R"({"headline": "worse"})"}) {
        write_text(folder.path / "verdict.json", broken);
        EXPECT_THROW(read_verdict(folder.path), Error) << broken;
    }
}
