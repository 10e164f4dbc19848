// How a shot is played, and what a config may ask for.
#include "core/error.h"
#include "core/files.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/shot_truth.h"

#include <gtest/gtest.h>
#include <filesystem>

namespace {

struct TemporaryConfig : testing::Test {
    std::filesystem::path file = std::filesystem::temp_directory_path() / "timeline_test.json";

    void TearDown() override { std::filesystem::remove(file); }
    Config read(const std::string& shots, const std::string& more = R"(, "techniques": [{"technique": "none"}])") {
        write_text(file, "{\"shots\": [" + shots + "]" + more + "}");
        return read_config(file);
    }
    std::string mistake(const std::string& shots,
                        const std::string& more = R"(, "techniques": [{"technique": "none"}])") {
        try {
            read(shots, more);
        } catch (const Error& e) {
            return e.what();
        }
        return "no mistake";
    }
};

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

}  // namespace

TEST(Timeline, WarmsUpPlaysAndHolds) {
    const std::vector<FrameStep> steps = timeline({.frames = {4, 6}, .warm_up = 2, .repeat = 3});
    const unsigned frames[] = {4, 4, 4, 6, 6, 6};
    ASSERT_EQ(steps.size(), 6u);
    for (unsigned i = 0; i < 6; ++i) {
        EXPECT_EQ(steps[i].index, i);
        EXPECT_EQ(steps[i].frame, frames[i]);
        EXPECT_EQ(steps[i].previous_frame, i == 0 ? std::nullopt : std::optional(frames[i - 1]));
        EXPECT_EQ(steps[i].is_warm_up, i < 2);
        EXPECT_EQ(steps[i].is_measured, i == 2 || i == 5);
        EXPECT_EQ(steps[i].is_held, i >= 3);
    }
}

TEST(Timeline, MeasuresTheLastAlone) {
    size_t measured = 0;
    for (const FrameStep& step : timeline({.frames = {0, 1, 2}, .measures_last_only = true}))
        measured += step.is_measured;
    EXPECT_EQ(measured, 1u);
}

TEST(Timeline, MeasuresFromAFrameOn) {
    std::vector<unsigned> measured;
    for (const FrameStep& step : timeline({.frames = {4, 5, 6, 7}, .measure_from = 6}))
        if (step.is_measured) measured.push_back(step.frame);
    EXPECT_EQ(measured, (std::vector<unsigned>{6, 7}));

    // A change is measured between two frames that both are.
    Shot shot{
        .config = {.frames = {4, 5, 6, 7}, .measure_from = 6}, .scene = {}, .camera = {}, .facts = {}, .steps = {}};
    std::vector<unsigned> compared;
    for (const FrameStep& step : timeline(shot.config))
        if (measures_difference(shot, step)) compared.push_back(step.frame);
    EXPECT_EQ(compared, (std::vector<unsigned>{7}));
}

TEST(Timeline, ComparesOnlyWhatResultsAreHeldAgainst) {
    const auto compared = [](const ShotConfig& config) {
        Shot shot{.config = config, .scene = {}, .camera = {}, .facts = {}, .steps = timeline(config)};
        return compared_frames(shot);
    };
    using Frames = std::set<unsigned>;
    EXPECT_EQ(compared({.frames = {0}, .warm_up = 3}), (Frames{0}));
    EXPECT_EQ(compared({.frames = {4, 5, 6}}), (Frames{4, 5, 6}));
    EXPECT_EQ(compared({.frames = {4, 5, 6, 7}, .measures_last_only = true}), (Frames{7}));
    EXPECT_EQ(compared({.frames = {4, 5, 6, 7}, .measure_from = 6}), (Frames{6, 7}));
    // What changes is seen against the frame before.
    EXPECT_EQ(compared({.frames = {4, 5, 6, 7}, .change = 6, .measures_last_only = true}), (Frames{5, 6, 7}));
}

TEST(Timeline, NamesWhatTellsShotsApart) {
    Shot shot{.config = {.extent = {32, 18}}, .scene = {}, .camera = {.name = "c"}, .facts = {}, .steps = {}};
    shot.scene.name = "s";
    EXPECT_EQ(shot.name(), "s.c.32x18");
    shot.config.frames = {5};
    EXPECT_EQ(shot.name(), "s.c.32x18.f5");
    shot.config.frames = {0, 1, 2};
    EXPECT_EQ(shot.name(), "s.c.32x18.f0-2");
    shot.config = {.extent = {32, 18}, .frames = {5, 8, 9}, .warm_up = 4, .repeat = 2};
    EXPECT_EQ(shot.name(), "s.c.32x18.f5-9.n3.w4.r2");
}

TEST_F(TemporaryConfig, ReadsHowAShotIsPlayed) {
    const Config config =
        read(R"({"scene": "fence", "frames": [2, 3], "warm_up": 5, "repeat": 9, "change": 3, "measure": "last"})");
    const ShotConfig& shot = config.shots.front();
    EXPECT_EQ(shot.frames, (std::vector<unsigned>{2, 3}));
    EXPECT_EQ(shot.warm_up, 5u);
    EXPECT_EQ(shot.repeat, 9u);
    EXPECT_EQ(shot.change, 3u);
    EXPECT_TRUE(shot.measures_last_only);
}

TEST_F(TemporaryConfig, ReadsFramesFromTo) {
    const Config config = read(R"({"scene": "fence", "frames": {"from": 7, "to": 9}, "measure_from": 8})");
    EXPECT_EQ(config.shots.front().frames, (std::vector<unsigned>{7, 8, 9}));
    EXPECT_EQ(config.shots.front().measure_from, 8u);
    EXPECT_THROW(read(R"({"scene": "fence", "frames": {"from": 7, "to": 6}})"), Error);
    EXPECT_THROW(read(R"({"scene": "fence", "frames": [9, 8]})"), Error);
}

TEST_F(TemporaryConfig, GivesTechniquesTheirSeeds) {
    const Config config = read(
        R"({"scene": "fence"})",
        R"(, "seeds": 3, "techniques": [{"technique": "none", "seeds": 1}, {"technique": "mcguire_dda", "baseline": true}])");
    EXPECT_EQ(config.techniques[0].seeds, (std::vector<unsigned>{0}));
    EXPECT_EQ(config.techniques[1].seeds, (std::vector<unsigned>{0})) << "no seed changes it";
    EXPECT_FALSE(config.techniques[0].is_baseline);
    EXPECT_TRUE(config.techniques[1].is_baseline);
}

TEST_F(TemporaryConfig, GivesPointsThatDependOnSeedsSeveral) {
    const std::string all = R"(, "techniques": [{"technique": "mcguire_dda"}, {"technique": "amd_sssr"},
        {"technique": "amd_sssr", "sweep": {"roughness_threshold_alpha": [0]}},
        {"technique": "mcguire_dda", "preset": "coarse", "seeds": [4, 6]}, {"technique": "diligent_ssr", "seeds": [7]}])";
    const auto seeds = [&](const std::string& of_study) {
        std::vector<std::vector<unsigned>> found;
        for (const PointConfig& v : read(R"({"scene": "fence"})", of_study + all).techniques) found.push_back(v.seeds);
        return found;
    };
    const std::vector<unsigned> eight = {0, 1, 2, 3, 4, 5, 6, 7}, two = {2, 9};
    EXPECT_EQ(seeds(""), (std::vector<std::vector<unsigned>>{{0}, eight, {0}, {4, 6}, {7}}));
    EXPECT_EQ(seeds(R"(, "seeds": [2, 9])"), (std::vector<std::vector<unsigned>>{{2}, two, {2}, {4, 6}, {7}}));
}

TEST_F(TemporaryConfig, NamesThePrimaryComparisons) {
    const auto primary = [&](const std::string& more) {
        const PrimaryComparisons p =
            read(R"({"scene": "fence"})", more + R"(, "techniques": [{"technique": "none"}])").primary;
        return p.metric + " " + p.mask + " " + p.target;
    };
    EXPECT_EQ(primary(""), "mse reflective specular");
    EXPECT_EQ(primary(R"(, "metrics": ["ssim", "flip"], "frame_metrics": [], "masks": ["all"], "targets": "image")"),
              "flip all image");
    EXPECT_EQ(primary(R"(, "primary": {"metric": "mse", "mask": "edge"})"), "mse edge specular");
    EXPECT_EQ(primary(R"(, "primary": {"metric": "flicker_relative"})"), "flicker_relative reflective specular");
    const std::string none = R"(, "techniques": [{"technique": "none"}])";
    for (const char* bad :
         {R"({"metric": "bias"})", R"({"metric": "mse_b"})", R"({"mask": "alll"})", R"({"masks": "all"})"})
        EXPECT_NE(mistake(R"({"scene": "fence"})", R"(, "primary": )" + std::string(bad) + none), "no mistake") << bad;
}

TEST_F(TemporaryConfig, SaysWhatIsWrong) {
    expect_contains(mistake(R"({"scene": "fence", "warmup": 3})"), "did you mean 'warm_up'?");
    expect_contains(mistake(R"({"scene": "fence", "repeat": 0})"), "'repeat'");
    expect_contains(mistake(R"({"scene": "fence", "frames": [3, 4], "change": 3, "repeat": 9})"), "after the first");
    expect_contains(mistake(R"({"scene": "fence", "frames": [3, 4], "change": 4, "repeat": 7})"),
                    "followed by 7 frames");
    expect_contains(mistake(R"({"scene": "fence"}, {"scene": ["sky_only", "fence"]})"), "'fence' comes twice");
    expect_contains(
        mistake(R"({"scene": "fence"})", R"(, "masks": ["refective"], "techniques": [{"technique": "none"}])"),
        "did you mean 'reflective'?");
    expect_contains(mistake(R"({"scene": "fence"})",
                            R"(, "masks": ["all"], "frame_masks": ["hit"], "techniques": [{"technique": "none"}])"),
                    "'frame_masks'");
}
