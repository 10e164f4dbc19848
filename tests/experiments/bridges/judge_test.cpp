// Judging a renderer's frames: that what errs as before passes, what errs more fails, and nothing passes that could not
// be compared. How often it is wrong is measured by judge_study.
#include "experiments/bridges/judge.h"
#include "experiments/report/report.h"

#include "core/error.h"
#include "tests/experiments/study/external_fixture.h"

#include <cmath>
#include <random>

namespace {

struct JudgeTest : StudyTest {
    const std::string view = "mirror_pillars.main.96x54";
    static constexpr unsigned seeds = 8;
    RenderedFrame frame;

    void SetUp() override {
        StudyTest::SetUp();
        const fs::path out = run(config(R"("mirror_pillars")", R"(, "targets": ["specular", "image"])"), "own");
        frame = rendered_frame(out, "mcguire_dda");
    }

    /// Frames of a stochastic renderer: reflections that vary by a fifth, `scale` times as bright in the mean.
    void write_noisy(const std::string& name, unsigned first_seed, float scale = 1) {
        describe_frames(folder / name, R"(, "seeds": 8)");
        write_exr(folder / name / view / "f0.off.exr", frame.without_reflections());
        for (unsigned seed = 0; seed < seeds; ++seed) {
            std::mt19937 random(first_seed + seed);
            std::normal_distribution<float> noise(scale, 0.2f);
            HostImage image = frame.without_reflections();
            for (size_t i = 0; i < image.pixel_count(); ++i)
                image.set_rgb(i, image.rgb(i) + noise(random) * frame.specular.rgb(i));
            write_exr(folder / name / view / ("f0.s" + std::to_string(seed) + ".exr"), image);
        }
    }
    JudgedFrames judge(const std::string& frames, const std::string& against = "", const std::string& scene = "",
                       const JudgeLimits& limits = {}) {
        return judge_frames({.frames = folder / frames,
                             .against = against.empty() ? fs::path() : folder / against,
                             .scene = scene,
                             .samples = 64,
                             .limits = limits,
                             .run = {.out = folder / "judged",
                                     .cache = folder / "cache",
                                     .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                                     .write_report = write_page}});
    }
    std::string refusal(const std::string& frames, const std::string& against = "", const std::string& scene = "") {
        try {
            judge(frames, against, scene);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }
};

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

EffectRow effect(const std::string& shot, double ratio, double p, const std::string& frame = "0") {
    EffectRow row{.shot = shot, .frame = frame, .technique = "v", .point = "frames"};
    row.against_technique = "v", row.against_point = "before", row.target = "specular", row.metric = "mse";
    row.mask = "reflective", row.ratio = ratio, row.low = 0.9 * ratio, row.high = 1.1 * ratio, row.p = p;
    row.verdict = verdict::undecided;
    return row;
}

Judgement judged(const std::vector<EffectRow>& effects) {
    return judge_effects(effects, {}, {"v", "frames"}, {"v", "before"});
}

}  // namespace

TEST(Judgement, IsWorseIfAViewIsAndAdjustsForTheirNumber) {
    EXPECT_EQ(judged({effect("a", 1.1, 0.009)}).verdict, judgement::worse);
    EXPECT_EQ(judged({effect("a", 1.1, 0.011)}).verdict, judgement::undecided);
    EXPECT_EQ(judged({effect("a", 0.9, 0.009)}).verdict, judgement::better);
    EXPECT_EQ(judged({effect("a", 1.1, 0.009), effect("b", 1, 0.8)}).verdict, judgement::undecided);
    const Judgement mixed = judged({effect("a", 0.5, 1e-6), effect("b", 1.1, 1e-6), effect("c", 1, 0.9)});
    EXPECT_EQ(mixed.verdict, judgement::worse);
    ASSERT_EQ(mixed.views.size(), 3u);
    EXPECT_EQ(mixed.views[0].verdict, judgement::better);
    EXPECT_EQ(mixed.views[2].verdict, judgement::undecided);
    // Of a sequence the mean over its frames, and of all rows those of its error alone.
    EXPECT_EQ(judged({effect("a", 1.1, 1e-6), effect("a", 1, 0.5, over_frames)}).verdict, judgement::undecided);
    EffectRow of_none = effect("a", 9, 1e-9);
    of_none.technique = "none";
    EXPECT_EQ(judged({effect("a", 1, 0.5), of_none}).verdict, judgement::undecided);
}

TEST(Judgement, SaysWhichChangeItWouldSee) {
    // Student's t of 7 degrees is 2.3646 at 97.5 %. A noncentral one lies beyond 3.4995 (99.5 %) in 95 % where it is
    // moved by 5.6441 (scipy's nct).
    EffectRow row = effect("a", 1, 0.5);
    row.seeds = 8, row.low = std::exp(-2.3646 * 0.02), row.high = std::exp(2.3646 * 0.02);
    EXPECT_NEAR(judged({row}).views.at(0).detectable, std::exp(5.6441 * 0.02), 1e-4);
    // One image a side: the truth's noise, nearly normal: 1.9693, and 4.2484 of 255 degrees.
    row.seeds = 1, row.low = std::exp(-1.9693 * 0.02), row.high = std::exp(1.9693 * 0.02);
    EXPECT_NEAR(judged({row}).views.at(0).detectable, std::exp(4.2484 * 0.02), 1e-4);
}

TEST(Judgement, ADeterministicRendererMayErrMoreWithinATolerance) {
    EffectRow exact = effect("a", 1.03, 0);
    exact.low = exact.high = exact.ratio, exact.p_equivalent = 0;
    exact.estimate = {.value = 1.03};
    const auto verdict = [&](const JudgeLimits& limits) {
        return judge(evidence_of_errors(std::span(&exact, 1), {}, {"v", "frames"}, {"v", "before"}, limits)).verdict;
    };
    EXPECT_EQ(verdict({}), judgement::worse) << "any certain increase";
    EXPECT_EQ(verdict({.worse_by = 1.02}), judgement::worse);
    EXPECT_EQ(verdict({.worse_by = 1.05}), judgement::equivalent);
    exact.ratio = exact.estimate.value = 1.4;
    EXPECT_EQ(verdict({.worse_by = 1.5}), judgement::equivalent) << "a tolerance above the margin is the margin";
    EXPECT_EQ(verdict({.worse_by = 1.35}), judgement::worse);
    exact.ratio = exact.estimate.value = 0.99;
    EXPECT_EQ(verdict({.worse_by = 1.5}), judgement::better) << "less needs no tolerance";
}

TEST(Judgement, KnowsHowFarTheLightWidensAnInterval) {
    EffectRow row = effect("a", 5, 0.06);
    row.estimate = {.value = 5, .excess_of_b = std::log(28.0)};  // logarithms
    EXPECT_NEAR(evidence_of_ratio(row, judged_number::error, {}, 0.05).of_light, 28, 1e-9);
}

TEST(Judgement, SaysNothingOfWhatCannotBeDecided) {
    EffectRow without = effect("a", 1, 0.5);
    without.p.reset(), without.interval = "none: 1 seed";
    EXPECT_THROW(judged({effect("b", 1, 0.5), without}), Error);
    EffectRow of_seeds = effect("a", 1, 0.5);
    of_seeds.verdict.clear();
    EXPECT_THROW(judged({of_seeds}), Error);
    EXPECT_THROW(judged({}), Error);
}

TEST_F(JudgeTest, PassesNoiseAndFailsWhatErrsMore) {
    write_noisy("week1", 0), write_noisy("week2", 100), write_noisy("darker", 200, 0.8f);
    const JudgedFrames alone = judge("week1");
    ASSERT_EQ(alone.errors.size(), 1u);
    EXPECT_FALSE(alone.against);
    EXPECT_LT(alone.errors[0].ratio_to_none.value(), 0.5);
    EXPECT_TRUE(alone.errors[0].low && alone.errors[0].high);
    EXPECT_TRUE(fs::exists(folder / "judged/report.html"));

    const Judgement same = judge("week2", "week1").against.value();
    EXPECT_EQ(same.verdict, judgement::equivalent);
    const JudgedFrames darker = judge("darker", "week1");
    const Judgement& worse = *darker.against;
    EXPECT_EQ(worse.verdict, judgement::worse);
    EXPECT_GT(worse.views.at(0).low, 1);
    // The page begins with what the terminal says, and verdict.json has it.
    const std::string page = read_text(folder / "judged/report.html");
    EXPECT_TRUE(says(darker.text.headline, "worse against"));
    EXPECT_TRUE(says(darker.text.headline, ": error in " + view));
    EXPECT_TRUE(says(page, "<p><b>" + darker.text.headline + "</b></p>"));
    EXPECT_FALSE(says(page, "too few for a verdict"));
    nlohmann::json file = read_json(folder / "judged/verdict.json");
    EXPECT_EQ(file["headline"], darker.text.headline);
    EXPECT_EQ(file["worse_by"], 1.0);
    EXPECT_EQ(file["numbers"][0]["verdict"], judgement::worse);
    // The same frames with a tolerance above the ratio: the study is done, and the page changes.
    const double ratio = worse.views.at(0).change;
    const JudgedFrames tolerated = judge("darker", "week1", "", {.worse_by = 1.2 * ratio});
    EXPECT_EQ(tolerated.against->verdict, judgement::equivalent);
    EXPECT_TRUE(says(read_text(folder / "judged/report.html"), tolerated.text.headline));
    EXPECT_EQ(read_json(folder / "judged/verdict.json")["worse_by"], 1.2 * ratio);
    EXPECT_EQ(judge("week1", "darker", "mirror_pillars").against.value().verdict, judgement::better);
    fs::copy(folder / "week1", folder / "copy", fs::copy_options::recursive);
    EXPECT_EQ(judge("copy", "week1").against.value().verdict, judgement::identical);
}

TEST_F(JudgeTest, NeverPassesWhatItCouldNotCompare) {
    write_noisy("frames", 0), write_noisy("before", 100);
    HostImage brighter = frame.image;
    for (float& v : brighter.values) v *= 1.5f;
    write_exr(folder / "before" / view / "f0.s5.exr", brighter);  // each image is looked at
    EXPECT_TRUE(says(refusal("frames", "before"), "1.5 times as bright"));
    fs::rename(folder / "before" / view / "f0.s0.exr", folder / "before" / view / "f7.s0.exr");
    EXPECT_TRUE(says(refusal("frames", "before"), "before lacks mirror_pillars.main.96x54/f0.s0.exr"));
    EXPECT_TRUE(says(refusal("before", "frames"), "frames lacks mirror_pillars.main.96x54/f7.s0.exr"));
    EXPECT_TRUE(says(refusal("frames", "", "fence"), "holds no images of 'fence'"));
    EXPECT_TRUE(says(refusal("nowhere"), "external.json"));
    write_text(folder / "before/external.json", R"({"name": "other", "engine": "another", "version": "1"})");
    EXPECT_TRUE(says(refusal("frames", "before"), "of the same renderer"));
}

TEST(Judgement, TakesForIdenticalWhatMeasuresAlikeToTheLastDigit) {
    const auto row = [](const std::string& technique, unsigned seed, std::optional<double> value) {
        ResultRow r{.shot = "a", .frame = "0", .technique = technique, .point = "default", .seed = seed};
        r.target = "specular", r.metric = "mse", r.mask = "all", r.value = value;
        return r;
    };
    const PointName a = {"a", "default"}, b = {"b", "default"};
    const auto alike = [&](const std::vector<ResultRow>& rows) { return measure_alike(rows, a, b); };
    EXPECT_TRUE(alike({row("a", 0, 1.0), row("b", 0, 1.0), row("c", 0, 2.0)}));
    EXPECT_FALSE(alike({row("a", 0, 1.0), row("b", 0, std::nextafter(1.0, 2.0))}));
    EXPECT_FALSE(alike({row("a", 0, 1.0), row("a", 1, 1.0), row("b", 0, 1.0)})) << "of other seeds";
    EXPECT_FALSE(alike({row("a", 0, {}), row("b", 0, {})})) << "nothing is known of either";
    EXPECT_FALSE(alike({}));
}

/// Several frames have more numbers than one: flicker, ghosts and visibility.
TEST_F(JudgeTest, JudgesSequences) {
    const auto write_frames = [&](const std::string& name, unsigned first_seed, float scale) {
        write_noisy(name, first_seed, scale);
        const fs::path images = folder / name / view;
        for (unsigned number = 1; number < 4; ++number)
            for (const std::string kind : {"off", "s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7"}) {
                const std::string next = kind == "off" ? kind : "s" + std::to_string((kind[1] - '0' + number) % seeds);
                fs::copy_file(images / ("f0." + next + ".exr"),
                              images / ("f" + std::to_string(number) + "." + kind + ".exr"));
            }
    };
    write_frames("week1", 0, 1), write_frames("week2", 100, 1), write_frames("darker", 200, 0.7f);
    const Judgement same = judge("week2", "week1").against.value();
    EXPECT_NE(same.verdict, judgement::worse);
    const JudgedFrames darker = judge("darker", "week1");
    EXPECT_EQ(darker.against->verdict, judgement::worse);
    std::set<std::string> judged;
    for (const JudgedView& number : darker.against->views) judged.insert(number.what);
    EXPECT_TRUE(judged.contains(judged_number::error));
    EXPECT_TRUE(judged.contains(judged_number::flicker));
    EXPECT_TRUE(judged.contains(judged_number::visibility)) << darker.text.headline;
}
