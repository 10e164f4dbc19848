#include "experiments/study/stability/stability.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "experiments/results/stability/stability_results.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/stability/case_run.h"
#include "experiments/study/stability/changed_shot.h"
#include "tests/error_message.h"
#include "tests/reading_limits.h"
#include "tests/variants/recommended_presets.h"
#include "tests/variants/technique_fixture.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace {

const std::filesystem::path scenes = std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes";

struct StabilityTest : TechniqueTest {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "stability";
    const std::filesystem::path table = folder / "cases.json";

    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override {
        std::filesystem::remove_all(folder);
        TechniqueTest::TearDown();
    }

    /// `cases`: what stands between the brackets.
    std::vector<StabilityRow> run(const std::string& cases, const std::vector<std::string>& techniques) {
        write_text(table, R"({"cases": [)" + cases + "]}");
        Device* const devices[] = {&device()};
        return run_stability(devices, {.table = table, .cases = {}, .techniques = techniques},
                             {.search_path = {scenes}, .cache = folder / "cache"},
                             [](const std::vector<StabilityRow>&, double) {});
    }
};

const std::string small = R"("group": "g", "why": "w", "size": [24, 14], "scene": "roughness_gradient", )";

const std::vector<std::string> corrected = {"mcguire_dda:best",    "amd_sssr:corrected",   "diligent_ssr:corrected",
                                            "frostbite_sssr:best", "simple_ssr:corrected", "four_mode_ssr:corrected"};

TEST_F(StabilityTest, TheTableNamesEachCaseOnceAndScenesThatExist) {
    std::set<std::string> names;
    const std::vector<std::string> known = list_scenes({scenes});
    for (const StabilityCase& c : read_stability_cases(stability_case_table())) {
        EXPECT_TRUE(names.insert(c.name).second) << c.name;
        EXPECT_TRUE(c.images || std::ranges::count(known, c.scene.shot.scene)) << c.name;
        EXPECT_GT(c.why.size(), 10u) << c.name;
    }
    EXPECT_GT(names.size(), 90u);
}

TEST_F(StabilityTest, UnknownKeysAndNamesAreErrors) {
    EXPECT_THROW(run(R"({"case": "a", "nearr": 1, )" + small + R"("frames": 1})", {"none"}), Error);
    EXPECT_THROW(run(R"({"case": "a", )" + small + R"("faults": [{"image": "lid", "value": 1}]})", {"none"}), Error);
    EXPECT_THROW(run(R"({"case": "a", )" + small + R"("frames": 1})", {"amd_ssr"}), Error);
}

TEST_F(StabilityTest, WrongTypesInTablesAreNamed) {
    const auto said = [&](const std::string& more) {
        write_text(table, R"({"cases": [{"case": "a", )" + small + more + "}]}");
        return error_message([&] {
            for (const StabilityCase& found : read_stability_cases(table)) changed_shot(found.scene, {scenes});
        });
    };
    EXPECT_EQ(said(R"("frames": 1)"), "no error");
    for (const auto& [more, key] : std::vector<std::pair<std::string, std::string>>{
             {R"("faults": [{"image": "lit", "value": []}])", "faults[0]: 'value' must be one value"},
             {R"("faults": [{"image": "lit", "times": [1, 2, 3, 4, 5]}])", "faults[0]: 'times' must be one value"},
             {R"("faults": [{"image": "lit", "value": 1, "at": "nan"}])", "faults[0]: 'at' must be in [0, 1]"},
             {R"("each": 3)", "each must be a JSON object"},
             {R"("each": {"near": 3})", "each: 'near' must be an array"},
             {R"("each": {"near": []})", "each: 'near' must be an array"},
             {R"("each": {"faults": [3]})", "each: 'faults' must be an array"},
             {R"("each": {"faults": [[3]]})", "each: faults[0] must be a JSON object"},
             {R"("each": {"faults": [[{"value": 1}]]})", "each: faults[0] lacks the key 'image'"},
             {R"("each": {"faults": [[{"image": "lit"}]]})", "each: faults[0] lacks the key 'value'"},
             {R"("each": {"view": [{"name": 3}]})", "'name' must be a text"},
             {R"("benign": [])", "benign must be a JSON object"},
             {R"("poses": [4294967296])", "'poses' must be an array of frame numbers"},
             {R"("quads": [{"corners": [1, 2, 3]}])", "quads[0]: 'corners' must be 3 or 4 points"},
             {R"("faults": [{"image": "lit", "value": "NaN"}])", "'value' must be a number, \"nan\""},
             // Numbers that float32 cannot hold, or whose products it cannot.
             {R"("faults": [{"image": "lit", "value": 1e39}])",
              "faults[0]: 'value' has the number 1e+39 outside of [-3"},
             {R"("faults": [{"image": "lit", "times": [1, -1e39]}])",
              "faults[0]: 'times' has the number -1e+39 outside"},
             {R"("faults": [{"image": "lit", "value": 1, "at": 1e39}])",
              "faults[0]: 'at' has the number 1e+39 outside"},
             {R"("radiance": 1e39)", "'radiance' = 1e+39 is outside [0, 1e+12]"},
             {R"("scale": [1e39, 1, 1])", "'scale' has the number 1e+39 outside of [-3"},
             {R"("scale": [3e38, 1, 1])", "'scale' has the factor 3e+38, whose size is outside of [0, 1e+09]"},
             {R"("instance_scale": [1, 0, 1])", "'instance_scale' has the factor 0, whose size is outside of [1e-09"},
             {R"("quads": [{"corners": [[1e39, 0, 0], [1, 0, 0], [0, 1, 0]]}])",
              "'corner' has the number 1e+39 outside"},
             {R"("quads": [{"corners": [[3e38, 0, 0], [1, 0, 0], [0, 1, 0]]}])", "outside of [-1e+09, 1e+09] m"},
             {R"("quads": [{"corners": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "emission": [3e38, 0, 0]}])",
              "'emission' has the part 3e+38 outside of [0, 1e+12]"},
             {R"("view": 3)", "view must be a JSON object"}}) {
        const std::string sentence = said(more);
        EXPECT_NE(sentence.find("cases.json: cases[0]"), std::string::npos) << more << ": " << sentence;
        EXPECT_NE(sentence.find(key), std::string::npos) << more << ": " << sentence;
    }
    write_text(table, R"({"cases": [{"case": 3, "each": {"near": [1]}, )" + small + R"("frames": 1}]})");
    EXPECT_NE(error_message([&] { read_stability_cases(table); }).find("cases[0]: 'case' must be a text"),
              std::string::npos);
}

TEST_F(StabilityTest, ImagesOfATableTakeNoMoreMemoryThanAllowed) {
    const LimitsOf limits({.memory = 100'000'000});
    const auto said = [&](const std::string& size) {
        write_text(table, R"({"cases": [{"case": "a", "group": "g", "why": "w",
            "images": {"size": )" +
                              size + R"(, "reference": 1, "test": 2}}]})");
        return error_message([&] { read_stability_cases(table); });
    };
    EXPECT_EQ(said("[700, 700]"), "no error");
    EXPECT_NE(said("[16384, 16384]").find("cases[0]: images: 16384 x 16384 pixels"), std::string::npos)
        << said("[16384, 16384]");
}

/// Poses that look alike and the benign form of a case share one, which the next run finds.
TEST_F(StabilityTest, ReferencesAreKeptInTheCacheOfStudies) {
    const std::string cases = R"({"case": "a", "perturbed": true, )" + small + R"("frames": 3},
        {"case": "b", )" + small +
                              R"("faults": [{"image": "lit", "value": "nan", "step": 1}]})";
    const std::vector<StabilityRow> first = run(cases, {"none"}), second = run(cases, {"none"});
    std::vector<std::filesystem::path> kept;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "cache"))
        if (entry.path().extension() == ".exr") kept.push_back(entry.path());
    EXPECT_EQ(kept.size(), 1u);
    ASSERT_EQ(first.size(), 4u);
    for (size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].error, second[i].error);
        // Rendered twice they would have taken other times.
        if (first[i].technique == "path_tracer") {
            EXPECT_EQ(first[i].time_ratio, 1.0);
        }
    }
}

/// What README.md promises of a preset: no stage holds a value that is not finite, and a fault reaches no other pixel.
void expect_finite(const CaseFindings& run, const std::string& name) {
    EXPECT_EQ(run.refusal, "") << name;
    EXPECT_EQ(run.non_finite, 0u) << name << run.first_non_finite;
    EXPECT_EQ(run.spread_pixels, 0u) << name;
    EXPECT_EQ(run.out_of_range(), 0u) << name;
}

/// Faults of all inputs in one frame, each in a pixel of its own: on the floor, and two where its reflections hit. An
/// original fails by them. Without a truth, which takes longer than all else.
TEST_F(StabilityTest, RecommendedPresetsAreFiniteInEveryStage) {
    std::string faults;
    const auto add = [&](const std::string& fault, const std::string& at) {
        faults +=
            std::string(faults.empty() ? "" : ", ") + R"({"step": 1, "image": )" + fault + R"(, "at": )" + at + "}";
    };
    add(R"("lit", "value": "nan")", "[0.5, 0.275]"), add(R"("depth", "value": "nan")", "[0.3, 0.275]");
    double x = 0.1;
    for (const char* fault : {R"("depth", "value": "nan")", R"("depth", "value": "-inf")",
                              R"("normal", "value": "nan")", R"("normal", "value": 0)", R"("lit", "value": "inf")",
                              R"("motion", "value": "nan")", R"("fallback", "value": "nan")"})
        add(fault, "[" + std::to_string(x += 0.1) + ", 0.75]");
    write_text(table, R"({"cases": [{"case": "faults", )" + small + R"("frames": 3, "lit": "direct", "faults": [)" +
                          faults + "]}]}");
    const StabilityCase what = read_stability_cases(table).at(0);
    std::vector<std::string> presets = recommended_presets();
    EXPECT_GE(presets.size(), 20u);
    presets.push_back("frostbite_sssr:frostbite_2015");
    const std::vector<PointConfig> points = all_points(presets);
    ASSERT_EQ(points.size(), presets.size());
    const CaseFrames frames = CaseDrawer(device(), {scenes}, folder / "cache", points).draw(what.scene, what.faults);
    for (const PointConfig& point : points) {
        const CaseResult run = run_case(device(), point, what, frames, {.is_scanned = true});
        if (point.preset == "frostbite_2015")
            EXPECT_GT(run.spread_pixels, 0u);
        else
            expect_finite(run, point.technique + ":" + point.preset + " ");
    }
}

/// What breaks the originals without a fault.
TEST_F(StabilityTest, CorrectedPresetsAreFiniteInExtremeScenes) {
    for (
        const StabilityRow& row :
        run(R"({"case": "planes", "group": "g", "why": "w", "size": [48, 27], "scene": "mirror_pillars", "near": 1e-3, "far": 1e6},
                {"case": "orthographic", "group": "g", "why": "w", "size": [24, 14], "scene": "axis_parallel", "camera": "orthographic"},
                {"case": "black", )" +
                small + R"("radiance": 0})",
            corrected))
        expect_finite(row, row.case_name + " " + row.technique + ":" + row.point + " ");
}

/// What the scan is for: the originals fail, each where its sheet says.
TEST_F(StabilityTest, OriginalsShowWhereTheyFail) {
    const std::vector<StabilityRow> rows =
        run(R"({"case": "lit", )" + small +
                R"("frames": 6, "faults": [{"step": 1, "image": "lit", "value": "nan", "at": [0.5, 0.275]}]},
           {"case": "planes", "group": "g", "why": "w", "size": [48, 27], "scene": "mirror_pillars", "near": 1e-3, "far": 1e6})",
            {"amd_sssr:repeatable", "frostbite_sssr:frostbite_2015", "none"});
    ASSERT_EQ(rows.size(), 8u);
    EXPECT_EQ(rows[3].technique, "frostbite_sssr");
    EXPECT_EQ(rows[3].verdict, Verdict::spreads) << "rays meet the bad pixel";
    EXPECT_GT(rows[3].spread_pixels, 0u);
    EXPECT_EQ(rows[1].technique, "none");
    EXPECT_EQ(rows[1].verdict, Verdict::ok);
    EXPECT_EQ(rows[6].technique, "amd_sssr");
    EXPECT_EQ(rows[6].first_non_finite, "amd_sssr/intersect: radiance");
    EXPECT_EQ(rows[6].zero_products.count("amd_sssr/intersect"), 1u);
    EXPECT_GE(rows[6].verdict, Verdict::inside);
}

/// Of each stage in which values that are not finite arise, failures.json says why.
TEST_F(StabilityTest, EachFailureOfTheOriginalsIsExplained) {
    const auto hit = [](const std::string& name, const std::string& fault) {
        return R"({"case": ")" + name + R"(", "family": "bad hit", )" +
               R"("group": "faults", "why": "w", "size": [24, 14], "scene": "roughness_gradient", "frames": 3, )" +
               R"("faults": [{"step": 1, "image": )" + fault + R"(, "at": [0.5, 0.275]}]},)";
    };
    const std::vector<StabilityRow> rows = run(
        hit("lit", R"("lit", "value": "nan")") + hit("depth", R"("depth", "value": "inf")") +
            R"({"case": "planes", "group": "depth", "why": "w", "size": [48, 27], "scene": "mirror_pillars", "near": 1e-3, "far": 1e6},
                {"case": "orthographic", "group": "sizes", "why": "w", "size": [24, 14], "scene": "axis_parallel", "camera": "orthographic"})",
        {"amd_sssr:repeatable", "diligent_ssr:current", "frostbite_sssr:frostbite_2015", "simple_ssr:slides_mirror",
         "mcguire_dda:tracer=cells"});
    write_rows(folder / "stability.csv", rows);
    write_rows(folder / "stability_stages.csv", stage_rows(rows, false));
    write_rows(folder / "stability_cases.csv", read_stability_cases(table));
    const StabilityResults tables = read_stability_results(folder);
    EXPECT_EQ(tables.rows.size(), rows.size());
    const std::vector<StageFailure> failures = stage_failures(tables);
    EXPECT_GT(failures.size(), 8u);
    for (const StageFailure& failure : failures)
        EXPECT_EQ(failure.unexplained, 0u) << failure.technique << failure.place;
}

/// A stranger's technique, which failures.json cannot name.
TEST_F(StabilityTest, FailuresThatNobodyKnowsAreExplainedInWords) {
    StageRow row;
    row.stage = "my_ssr/shade", row.image = "radiance", row.nan = 3;
    row.technique = "my_ssr", row.point = "default", row.case_name = "lit_nan";
    StabilityCaseName what;
    what.name = what.family = "lit_nan", what.group = "faults";
    const std::vector<StageFailure> failures = stage_failures({.rows = {}, .cases = {what}, .stages = {row}});
    const std::string text = failures_text(failures);
    for (const char* part : {"my_ssr/shade: radiance, in 1 case: lit_nan", "that ssrlab does not know, in 1 run",
                             "look in its shader for divisions by 0", "repair_inputs"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(StabilityTest, FailuresNameTechniquesAndCasesThatExist) {
    std::set<std::string> techniques, cases;
    for (const PointConfig& p : all_points())
        for (const std::string& name : names_of_point(p)) techniques.insert(name);
    for (const StabilityCase& c : read_stability_cases(stability_case_table()))
        cases.insert({c.name, c.family, c.group});
    for (const KnownFailure& failure : read_known_failures(known_failures_file())) {
        for (const std::string& name : failure.techniques) EXPECT_TRUE(techniques.contains(name)) << name;
        for (const std::string& name : failure.cases) EXPECT_TRUE(cases.contains(name)) << name;
        EXPECT_FALSE(failure.operation.empty() || failure.fix.empty());
    }
}

/// The output of one mirror ray is a colour of the lit image: a step of 2^-11 of it is a step of 2^-11 there, or of its
/// bilinear mean; without reflections none.
TEST_F(StabilityTest, AmplificationOfTheLitColourIsThatOfAMean) {
    const std::vector<StabilityRow> rows = run(
        R"({"case": "a", "group": "g", "why": "w", "size": [48, 27], "scene": "mirror_pillars", "perturbed": true})",
        {"none", "mcguire_dda:published"});
    EXPECT_EQ(*rows[1].lit_p999, 0.0);
    EXPECT_GT(*rows[2].lit_median, 0.05);
    EXPECT_LT(*rows[2].lit_p999, 10.0);  // of the brightest pixel, over the mean
}

TEST_F(StabilityTest, ErrorsAndDriftAreWhatTheyMustBe) {
    const std::vector<StabilityRow> rows =
        run(R"({"case": "rest", )" + small + R"("frames": 120}, {"case": "scaled", )" + small +
                R"("scale": 1000, "same_truth": true})",
            {"none"});
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(*rows[1].drift, 0.0);
    EXPECT_EQ(rows[1].error_ratio, 1.0);
    EXPECT_LT(*rows[2].error, 0.01) << "the path tracer's picture depends on the unit of length";
    EXPECT_NEAR(*rows[3].error_ratio, 1.0, 0.05);
}

/// What claims to know of no unit of length keeps its error in scenes of any size, but for rounding, which moves single
/// hits by a pixel: of 1296 pixels one weighs up to 1 % of the error. The path tracer's picture differs where rounding
/// moves a path across the border of two cells with other probabilities to go on: one of a pixel's 64 samples that ends
/// has up to ten times the weight elsewhere, which is (10 / 64)^2 / 1296 = 2e-5 of the squares; five such may.
TEST_F(StabilityTest, ErrorsOfWhatHasNoUnitDoNotDependOnScale) {
    std::string cases;
    for (const char* scale : {"1e-3", "1e3", "1e5"})
        cases +=
            R"({"case": ")" + std::string(scale) +
            R"(", "group": "g", "why": "w", "size": [48, 27], "scene": "mirror_pillars", "frames": 2, "same_truth": true, "scale": )" +
            scale + "},";
    cases.pop_back();
    for (const StabilityRow& row : run(cases, {"mcguire_dda:any_scale", "simple_ssr:corrected", "frostbite_sssr:best",
                                               "diligent_ssr:corrected", "four_mode_ssr:corrected"}))
        if (row.technique == "path_tracer")
            EXPECT_LT(*row.error, 1e-4) << row.case_name;
        else
            EXPECT_NEAR(*row.error_ratio, 1.0, 0.02) << row.technique << " " << row.case_name;
}

/// Emission comes through the holes of a mask as from two squares; instances and meshes whose transforms undo each
/// other give the picture without them, but for rounding (1e-8, and more where it moves a ray past an edge). The masked
/// one's samples are others: 64 of them per pixel.
TEST_F(StabilityTest, ThePathTracerKnowsMasksAndIllConditionedTransforms) {
    const std::string shape = R"("group": "g", "why": "w", "size": [24, 14], "frames": 1, )";
    const auto light = [](const std::string& corners, const std::string& more = "") {
        return R"({"metalness": 0, "emission": [10, 10, 10], "corners": [)" + corners + "]" + more + "}";
    };
    const std::vector<StabilityRow> rows =
        run(R"({"case": "mask", "same_truth": true, "scene": "mirror_pillars", )" + shape + R"("quads": [)" +
                light("[-1, 2, -6], [1, 2, -6], [1, 4, -6], [-1, 4, -6]", R"(, "masked": true)") +
                R"(], "benign": {"quads": [)" + light("[-1, 2, -6], [0, 2, -6], [0, 3, -6], [-1, 3, -6]") + "," +
                light("[0, 3, -6], [1, 3, -6], [1, 4, -6], [0, 4, -6]") +
                R"(]}}, {"case": "scale", "same_truth": true, "scene": "curved_mirror", )" + shape +
                R"("instance_scale": [1e4, 1, 1e-4]})",
            {"none"});
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_LT(*rows[0].error, 0.01);
    EXPECT_LT(*rows[2].error, 1e-4);
}

TEST_F(StabilityTest, WhatADeviceCannotHoldIsRefusedWithAnAnswer) {
    const std::vector<StabilityRow> rows =
        run(R"({"case": "a", "group": "g", "why": "w", "scene": "roughness_gradient", "size": [65536, 1], "frames": 1,
               "lit": "direct", "benign": {"size": [24, 14]}})",
            {"none"});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].verdict, Verdict::refused);
    EXPECT_NE(rows[0].refusal.find("choose a smaller size"), std::string::npos) << rows[0].refusal;
}

TEST(StabilityVerdict, IsOfSeveralSeedsWhereOneMightTurnIt) {
    const auto row = [](double error, double benign_error) {
        StabilityRow r;
        set_errors(r, error, benign_error);
        return r;
    };
    constexpr size_t small = 64, usual = 96 * 54;
    EXPECT_TRUE(is_near_worse(row(0.44, 0.3), usual));
    EXPECT_TRUE(is_near_worse(row(0.46, 0.3), usual));
    EXPECT_FALSE(is_near_worse(row(0.6, 0.3), usual));
    EXPECT_TRUE(is_near_worse(row(0.6, 0.3), small));
    EXPECT_FALSE(is_near_worse(row(0.3, 0.3), usual));
    EXPECT_FALSE(is_near_worse(row(0.015, 0.01), usual)) << "no picture shows it";
    EXPECT_FALSE(is_near_worse({}, usual));
}

TEST(StabilityErrors, AreOfJudgedPixelsThatAreFinite) {
    CaseFrames frames;
    EXPECT_FALSE(relative_error(frames, HostImage({4, 1}, 3))) << "no truth is known";
    frames.truth = HostImage({4, 1}, 3, 2.0f);
    frames.is_judged = {1, 1, 0, 1};
    HostImage image = frames.truth;
    image.set_rgb(0, glm::vec3(3.0f)), image.set_rgb(2, glm::vec3(100.0f));
    image.set_rgb(3, glm::vec3(0.0f, std::numeric_limits<float>::quiet_NaN(), 0.0f));
    EXPECT_EQ(relative_error(frames, image), 3.0 / 24);
    EXPECT_EQ(relative_difference(frames, frames.truth, image), 3.0 / 24);
    frames.truth = HostImage({4, 1}, 3);
    EXPECT_FALSE(relative_error(frames, image)) << "the truth is black";
}

TEST(StabilityResults, ComeBackAsTheyWereWritten) {
    const auto folder = std::filesystem::temp_directory_path() / "stability_tables";
    std::filesystem::create_directories(folder);
    StabilityCase what;
    what.name = what.family = "a, b", what.group = "g", what.why = "\"w\"";
    StabilityRow row;
    row.case_name = what.name, row.group = what.group, row.technique = "amd_sssr", row.point = "slides";
    set_errors(row, 0.3, 0.1);
    row.spread_pixels = 3, row.excess = 0.5, row.lit_p999 = 7.0, row.gain = 0.25;
    row.stages = {{"trace", "radiance", 2, 0, 1.5}, {"blur", "rows", 0, 0, 1.5}};
    row.verdict = verdict_of(row);
    write_rows(folder / "stability_cases.csv", std::vector{what});
    write_rows(folder / "stability.csv", std::vector{row});
    write_rows(folder / "stability_stages.csv", stage_rows({row}, true));
    const StabilityResults tables = read_stability_results(folder);
    ASSERT_EQ(tables.rows.size(), 1u);
    EXPECT_EQ(row_json(tables.rows[0]), row_json(row));
    EXPECT_EQ(tables.rows[0].verdict, Verdict::spreads);
    EXPECT_EQ(row_json(tables.cases.at(0)), row_json(what));
    ASSERT_EQ(tables.stages.size(), 2u);
    EXPECT_EQ(stage_failures(tables).size(), 1u) << "where all is finite nothing fails";
    EXPECT_EQ(stage_rows({row}, false).size(), 1u);

    std::string text = read_text(folder / "stability.csv");
    text.replace(text.find("spreads"), 7, "unheard");
    write_text(folder / "stability.csv", text);
    EXPECT_THROW(read_stability_results(folder), Error);
    write_rows(folder / "stability.csv", std::vector{row});
    write_rows(folder / "stability_cases.csv", std::vector<StabilityCase>{});
    EXPECT_THROW(read_stability_results(folder), Error) << "a case that nobody knows";
    std::filesystem::remove_all(folder);
}

TEST(StabilityResults, SayWhereNumbersMayStayUnseen) {
    StabilityRow row;
    row.technique = "mine", row.point = "default";
    EXPECT_EQ(hidden_text({row, row}), "");
    row.zero_products = {{"mine/trace", 2u}, {"mine/blur", std::nullopt}};
    const std::string text = hidden_text({row, row});
    EXPECT_NE(
        text.find(
            "lower bounds:\n  mine/blur: products that cannot be counted (mine)\n  mine/trace: 2 products (mine)\n"),
        std::string::npos)
        << text;
}

/// Between facing mirrors of reflectance 0.95 or less a frame adds at most that much of what the one before added.
TEST_F(StabilityTest, MirrorsInMirrorsFadeAway) {
    for (const StabilityRow& row :
         run(R"({"case": "a", "group": "g", "why": "w", "size": [48, 27], "scene": "facing_mirrors",
                                           "frames": 8, "feeds_back": true})",
             {"mcguire_dda:best", "amd_sssr:corrected"}))
        if (row.technique != "path_tracer") {
            ASSERT_TRUE(row.gain) << row.technique;
            EXPECT_LT(*row.gain, 1.0) << row.technique;
        }
}

TEST_F(StabilityTest, MetricsOfExtremePicturesAreNumbersOrRefused) {
    for (const StabilityRow& row :
         run(R"({"case": "a", "group": "g", "why": "w", "images": {"reference": 1e30, "test": [1e30, 3e30]}})",
             {"none"})) {
        if (row.refusal.empty()) {
            EXPECT_TRUE(std::isfinite(*row.error)) << row.point;
        }
        if (row.point == "relmse") {  // the mean of (2 i / 31)^2 over 32 columns
            EXPECT_NEAR(*row.error, 4.0 / 961 * (31.0 * 63 / 6), 1e-5);
        }
    }
}

}  // namespace
