// What a config may ask for beyond a list of shots and techniques: extending another, designs of points, conditions,
// settings of shots, labels and names. Over 400 lines, as all of them are one short config each, made by one helper.
#include "core/error.h"
#include "core/files.h"
#include "experiments/study/config/config_parts.h"
#include "experiments/study/config/points/conditions.h"
#include "experiments/study/config/points/point_name.h"
#include "experiments/study/config/points/unit_samples.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

struct Designs : testing::Test {
    fs::path folder = fs::temp_directory_path() / "designs";

    void TearDown() override { fs::remove_all(folder); }
    Config read(const std::string& text, const std::string& name = "study.json") {
        write_text(folder / name, text);
        return read_config(folder / name);
    }
    /// A study of one scene.
    Config of(const std::string& techniques, const std::string& shot = R"({"scene": "fence"})") {
        return read(R"({"shots": [)" + shot + R"(], "techniques": [)" + techniques + "]}");
    }
    std::string mistake_in(const std::string& text) {
        try {
            read(text);
        } catch (const Error& e) {
            const std::string message = e.what(), name = (folder / "").string();
            return message.starts_with(name) ? message.substr(name.size()) : message;
        }
        return "no mistake";
    }
    std::string mistake(const std::string& entry) {
        return mistake_in("{\"shots\": [{\"scene\": \"fence\"}],\n \"techniques\": [\n" + entry + "]}");
    }
    static std::vector<std::string> points(const Config& config) {
        std::vector<std::string> names;
        for (const PointConfig& v : config.techniques) names.push_back(v.technique + " " + v.point);
        return names;
    }
    static std::vector<json> swept(const Config& config) {
        std::vector<json> values;
        for (const PointConfig& v : config.techniques) values.push_back(v.swept);
        return values;
    }
};

using Names = std::vector<std::string>;

void expect_starts(const std::string& text, const std::string& start) {
    EXPECT_EQ(text.substr(0, start.size()), start);
}

std::string dda(const std::string& design) { return R"({"technique": "mcguire_dda", )" + design + "}"; }

}  // namespace

TEST_F(Designs, AConfigIsPatchedByWhatExtendsIt) {
    read(R"({"title": "base", "seeds": 4, "timing": {"frames": 20, "warm_up": 5}, "shots": [{"scene": "fence"}],
             "techniques": [{"technique": "none"}, {"technique": "mcguire_dda", "parameters": {"dda.stride": 2, "dda.refine": true}},
                          {"technique": "amd_sssr", "preset": "best", "label": "a"}, {"technique": "amd_sssr", "preset": "best",
                           "label": "b", "sweep": {"samples_per_quad": [1]}}]})",
         "base/base.json");
    read(R"({"extends": "../base/base.json", "title": "middle", "timing": {"frames": null},
             "techniques": [{"technique": "mcguire_dda", "parameters": {"dda.stride": 4, "dda.refine": null}},
                          {"technique": "mcguire_dda", "preset": "best"}]})",
         "middle/middle.json");
    const Config config = read(R"({"extends": "middle/middle.json", "shots": [{"scene": "sky_only"}],
             "techniques": [{"technique": "none", "remove": true},
                          {"technique": "amd_sssr", "preset": "best", "label": "b", "seeds": 2},
                          {"technique": "mcguire_dda", "preset": "best", "label": "named"}]})");
    EXPECT_EQ(points(config),
              (Names{"mcguire_dda default", "amd_sssr best", "amd_sssr best samples_per_quad=1", "mcguire_dda best"}));
    EXPECT_EQ(config.techniques[0].parameters, (json{{"dda.stride", 4}}));
    EXPECT_EQ(config.techniques[1].seeds.size(), 4u);
    EXPECT_EQ(config.techniques[2].seeds.size(), 2u);
    EXPECT_EQ(config.techniques[3].label, "named");
    EXPECT_EQ(config.title, "middle");
    EXPECT_EQ(config.timing.frames, 15u) << "as if nobody had said";
    EXPECT_EQ(config.timing.warm_up, 5u);
    ASSERT_EQ(config.shots.size(), 1u) << "shots are replaced";
    EXPECT_EQ(config.shots[0].scene, "sky_only");
    EXPECT_FALSE(config.source.contains("extends"));
    // What is kept stands alone.
    EXPECT_EQ(points(read(config.source.dump(), "alone.json")), points(config));

    // Mistakes are reported where they were made.
    write_text(folder / "base/broken.json",
               "{\"techniques\": [{\"technique\": \"none\"},\n  {\"technique\": \"mcguire\"}]}");
    expect_starts(mistake_in(R"({"extends": "base/broken.json", "shots": [{"scene": "fence"}]})"),
                  "base/broken.json:2:4: techniques[1]: ");
    const auto extending = [](const std::string& entry) {
        return R"({"extends": "middle/middle.json", "techniques": [)" + entry + "]}";
    };
    expect_starts(mistake_in(extending(R"({"technique": "amd_sssr", "preset": "best"})")),
                  "study.json:1:50: techniques: the extended config has 2 entries");
    expect_starts(mistake_in(extending(R"({"technique": "simple_ssr", "remove": true})")),
                  "study.json:1:50: techniques: nothing to remove");
    expect_starts(mistake_in(R"({"extends": "study.json"})"), "study.json:1:2: 'extends' leads back");
    expect_starts(mistake_in(R"({"extends": "nowhere.json"})"), "study.json:1:2: 'extends': there is no file");
}

TEST_F(Designs, PathsOfCapturesAreThoseOfTheFileThatNamesThem) {
    write_text(folder / "base/frame/gbuffer.exr", "looked at later");
    read(R"({"shots": [{"gbuffer": "frame", "reference": "../truth.exr"}], "techniques": [{"technique": "none"}]})",
         "base/base.json");
    const ShotConfig shot = read(R"({"extends": "base/base.json"})").shots.at(0);
    EXPECT_EQ(shot.gbuffer.lexically_normal(), folder / "base/frame");
    EXPECT_EQ(shot.reference.lexically_normal(), folder / "truth.exr");
}

TEST_F(Designs, MistakesNameLineAndColumn) {
    EXPECT_EQ(mistake(R"({"technique": "none"},
                         {"technique": "none", "prest": "best"})"),
              "study.json:4:48: techniques[1]: unknown key 'prest'; did you mean 'preset'?");
    expect_starts(
        mistake("// why\n{\"technique\": \"mcguire_dda\", /* \"{ */ \"parameters\": {\n\"dda.strid\": 2}}"),
        "study.json:5:1: techniques[0]: parameters: unknown parameter 'dda.strid'; did you mean 'dda.stride'?");
    expect_starts(
        mistake("{\"technique\": \"mcguire_dda\",\n \"sweep\": {\"dda.refine\": [true],\n  \"dda.stride\": [1, 0]}}"),
        "study.json:5:3: techniques[0]: sweep: parameter 'dda.stride' = 0 is outside");
    expect_starts(mistake("{\"technique\": \"n\\\"o\\\\\", \"preset\": 3}"),
                  "study.json:3:2: techniques[0]: unknown technique");
    expect_starts(mistake_in("{\"shots\": [{\"scene\": \"fence\",\r\n\t\"resolution\": [0, 4]}]}"),
                  "study.json:2:2: shots[0]: 'resolution'");
}

TEST_F(Designs, AxesAreListsOrRanges) {
    const auto strides = [&](const std::string& axis) {
        std::vector<json> values;
        for (const json& point : swept(of(dda(R"("sweep": {"dda.stride": )" + axis + "}"))))
            values.push_back(point["dda.stride"]);
        return json(values);
    };
    EXPECT_EQ(strides("[4, 1]"), json({4, 1}));
    EXPECT_EQ(strides(R"({"lin": [1, 9, 5]})"), json({1, 3, 5, 7, 9}));
    EXPECT_EQ(strides(R"({"lin": [3, 1, 9]})"), json({3, 2, 1})) << "whole numbers once";
    EXPECT_EQ(strides(R"({"log": [1, 64, 4]})"), json({1, 4, 16, 64}));
    const Config thickness = of(dda(R"("sweep": {"dda.thickness": {"lin": [0.1, 0.4, 4]}})"));
    EXPECT_EQ(points(thickness).at(2), "mcguire_dda dda.thickness=0.3") << "as float32, not 0.30000000000000004";
    for (const char* bad :
         {"[]", "3", R"({"lin": [1, 9]})", R"({"lin": [1, 9, 1]})", R"({"lin": [1, 1, 4]})", R"({"log": [0, 9, 4]})",
          R"({"log": [1, 9, 1e9]})", R"({"lin": [1, 2, 3], "log": [1, 2, 3]})", R"({"lin": [0, 9, 4]})", "{}"})
        expect_starts(mistake(dda(R"("sweep": {"dda.stride": )" + std::string(bad) + "}")),
                      "study.json:3:40: techniques[0]: sweep: ");
    expect_starts(mistake(dda(R"("sweep": {"dda.refine": {"lin": [0, 1, 2]}})")),
                  "study.json:3:40: techniques[0]: sweep: 'dda.refine' must be an array of values (true, false), not ");
}

TEST_F(Designs, WholeNumbersMayBeWrittenWithAPoint) {
    const Config config = of(dda(R"("parameters": {"dda.max_steps": 1e2}, "sweep": {"dda.stride": [4.0, 2]})"),
                             R"({"scene": "fence", "frames": 3.0, "resolution": [96.0, 5.4e1]})");
    EXPECT_EQ(points(config), (Names{"mcguire_dda dda.stride=4", "mcguire_dda dda.stride=2"}))
        << "not 4.0: another point";
    EXPECT_EQ(config.techniques.at(0).parameters.dump(), R"({"dda.max_steps":100,"dda.stride":4})");
    EXPECT_EQ(config.shots.at(0).frames, (std::vector<unsigned>{0, 1, 2}));
    EXPECT_EQ(config.shots.at(0).extent, glm::uvec2(96, 54));
    EXPECT_NE(mistake(dda(R"("sweep": {"dda.stride": [4.5]})")).find("is a whole number, not 4.5"), std::string::npos);
}

TEST_F(Designs, CombineAxesInSeveralWays) {
    EXPECT_EQ(
        swept(of(dda(R"("zip": {"dda.stride": [1, 2], "dda.refine": [true, false]})"))),
        (std::vector<json>{{{"dda.stride", 1}, {"dda.refine", true}}, {{"dda.stride", 2}, {"dda.refine", false}}}));
    EXPECT_EQ(of(dda(R"("sweep": {"dda.stride": {"lin": [1, 4, 4]}, "dda.refine": [true, false]})")).techniques.size(),
              8u);
    expect_starts(mistake(dda(R"("zip": {"dda.stride": [1, 2], "dda.refine": [true]})")),
                  "study.json:3:30: techniques[0]: 'zip' pairs");
    expect_starts(mistake(dda(R"("zip": {"dda.stride": [1]}, "each": {"dda.refine": [true]})")),
                  "study.json:3:58: techniques[0]: 'zip' and 'each'");
    // Refused before memory is filled.
    const std::string thousand = R"({"lin": [0.1, 0.9, 1000]})";
    expect_starts(
        mistake(dda(R"("sweep": {"dda.thickness": )" + thousand + R"(, "dda.max_distance": {"lin": [1, 9, 1000]}})")),
        "study.json:3:30: techniques[0]: 'sweep' makes 1e+06 points; at most 100000 are allowed");
}

TEST_F(Designs, SamplesFillTheirRanges) {
    const auto design = [](const std::string& kind, unsigned seed) {
        return dda(
            "\"" + kind + R"(": {"count": 64, "seed": )" + std::to_string(seed) +
            R"(, "axes": {"dda.thickness": {"log": [0.01, 1]}, "dda.stride": {"lin": [1, 4]}, "dda.refine": [true, false]}})");
    };
    for (const std::string kind : {"random", "latin_hypercube", "sobol"}) {
        const std::vector<json> points = swept(of(design(kind, 1)));
        ASSERT_EQ(points.size(), 64u);
        std::map<json, int> strides, refines, decades;
        for (const json& point : points) {
            const double t = point["dda.thickness"];
            EXPECT_TRUE(t >= 0.01 && t <= 1) << t;
            ++strides[point["dda.stride"]], ++refines[point["dda.refine"]], ++decades[t < 0.1];
        }
        if (kind == "random") {
            EXPECT_EQ(strides.size(), 4u);
        } else {
            EXPECT_EQ(strides, (std::map<json, int>{{1, 16}, {2, 16}, {3, 16}, {4, 16}})) << kind;
            EXPECT_EQ(refines[true], 32) << kind;
            EXPECT_EQ(decades[true], 32) << kind;
        }
        EXPECT_EQ(swept(of(design(kind, 1))), points) << kind;
        EXPECT_NE(swept(of(design(kind, 2))), points) << kind;
    }
    EXPECT_EQ(of(dda(R"("random": {"count": 50, "axes": {"dda.stride": {"lin": [1, 3]}}})")).techniques.size(), 3u)
        << "equal points count once";
    expect_starts(mistake(dda(R"("sobol": {"count": 4, "axes": {"dda.stride": {"lin": [0, 3]}}})")),
                  "study.json:3:61: techniques[0]: sobol: axes: parameter 'dda.stride' = 0 is outside");
    expect_starts(mistake(dda(R"("random": {"count": 200000, "axes": {"dda.stride": [1]}})")),
                  "study.json:3:41: techniques[0]: random: 'count'");
}

/// Every interval of each axis holds exactly its share, whatever the seed.
TEST(UnitSamples, AreStratified) {
    for (const uint32_t seed : {0u, 7u}) {
        const UnitSamples latin = latin_hypercube_samples(100, 5, seed), sobol = sobol_samples(64, 5, seed);
        for (size_t axis = 0; axis < 5; ++axis) {
            std::set<int> of_latin;
            for (const auto& sample : latin) of_latin.insert(int(std::floor(sample[axis] * 100)));
            EXPECT_EQ(of_latin.size(), 100u);
            for (const int intervals : {2, 8, 64}) {
                std::map<int, int> count;
                for (const auto& sample : sobol) ++count[int(std::floor(sample[axis] * intervals))];
                EXPECT_EQ(count.size(), size_t(intervals));
                for (const auto& [interval, n] : count) EXPECT_EQ(n, 64 / intervals);
            }
        }
    }
}

/// The centred L2 discrepancy (Hickernell 1998, eq. 5.3) in two dimensions, as scipy.stats.qmc.discrepancy() computes
/// it.
double discrepancy(const UnitSamples& samples) {
    const double n = double(samples.size());
    double single = 0, pairs = 0;
    for (const auto& x : samples) {
        double product = 1;
        for (const double v : x) product *= 1 + 0.5 * std::abs(v - 0.5) - 0.5 * std::pow(v - 0.5, 2);
        single += product;
        for (const auto& y : samples) {
            double other = 1;
            for (size_t d = 0; d < x.size(); ++d)
                other *= 1 + 0.5 * std::abs(x[d] - 0.5) + 0.5 * std::abs(y[d] - 0.5) - 0.5 * std::abs(x[d] - y[d]);
            pairs += other;
        }
    }
    return std::pow(13.0 / 12.0, double(samples.front().size())) - 2 / n * single + pairs / (n * n);
}

/// scipy 1.10 has 2.40e-4 for the plain sequence, 1.46e-4 to 1.65e-4 for scrambled ones, and 2.1e-3 to 1.7e-2 at random
/// (50 seeds).
TEST(UnitSamples, OfSobolAreEvenInTwoDimensions) {
    for (const uint32_t seed : {0u, 1u, 2u}) {
        EXPECT_LT(discrepancy(sobol_samples(64, 2, seed)), 3e-4);
        EXPECT_GT(discrepancy(random_samples(64, 2, seed)), 1e-3);
    }
}

TEST_F(Designs, ConditionsOnParametersLeavePointsOut) {
    const std::string sweep = R"("sweep": {"dda.stride": [1, 2, 4], "dda.refine": [true, false]})";
    const auto left = [&](const std::string& condition) { return points(of(dda(sweep + ", " + condition))).size(); };
    EXPECT_EQ(left(R"("only_if": {"dda.stride": {"at_least": 2}, "dda.refine": true})"), 2u);
    EXPECT_EQ(left(R"("skip_if": {"dda.stride": {"at_least": 2}, "dda.refine": true})"), 4u);
    EXPECT_EQ(left(R"("only_if": {"dda.stride": [1, 4]})"), 4u);
    EXPECT_EQ(left(R"("only_if": {"dda.stride": {"not": [1, 4]}})"), 2u);
    EXPECT_EQ(left(R"("only_if": {"dda.stride": {"above": 1, "below": 4}}, "skip_if": {"dda.refine": false})"), 1u);
    EXPECT_EQ(left(R"("only_if": {"dda.thickness": {"at_most": 0.5}})"), 6u) << "of any parameter, swept or not";
    for (const char* bad :
         {R"("only_if": {"dda.strid": 1})", R"("only_if": {"dda.stride": "a"})",
          R"("skip_if": {"dda.stride": {"least": 1}})", R"("skip_if": {"dda.stride": []})",
          R"("only_if": {"dda.stride": 3})", R"("only_if": {"dda.refine": {"above": 0}})",
          R"("only_if": {"shot.is_stil": true})", R"("only_if": {"dda.stride": {"not": {"above": 1}}})"})
        expect_starts(mistake(dda(sweep + ", " + bad)), "study.json:3:");
}

TEST_F(Designs, ConditionsOnShotsAreKeptForThem) {
    const Config config =
        of(dda(R"("sweep": {"dda.stride": [1, 2]}, "skip_if": {"shot.is_still": true, "dda.stride": 2})") +
           R"(, {"technique": "none", "only_if": {"shot.max_roughness": {"at_most": 0.1}, "shot.height": 36}})");
    ASSERT_EQ(config.techniques.size(), 3u);
    Shot shot{.config = {.extent = {64, 36}}, .scene = {}, .camera = {}, .facts = {.max_roughness = 0.1f}, .steps = {}};
    const auto running = [&] { return points(config_on(config, shot)); };
    EXPECT_EQ(running(), (Names{"mcguire_dda dda.stride=1", "none default"}));
    EXPECT_EQ(why_skipped(config.techniques[1], shot), R"(skip_if {"shot.is_still":true})");
    shot.facts.camera_moves = true;
    EXPECT_EQ(running(), (Names{"mcguire_dda dda.stride=1", "mcguire_dda dda.stride=2", "none default"}));
    shot.facts.max_roughness = 0.2f;
    EXPECT_EQ(running(), (Names{"mcguire_dda dda.stride=1", "mcguire_dda dda.stride=2"}));
}

TEST_F(Designs, ShotsHaveAxesOfTheirOwn) {
    const auto read_shots_of = [&](const std::string& shots, const std::string& study = "") {
        Names names;
        for (const ShotConfig& s :
             read(R"({"shots": [)" + shots + R"(], "techniques": [{"technique": "none"}])" + study + "}").shots)
            names.push_back(
                Shot{.config = s, .scene = {}, .camera = {.name = s.camera}, .facts = {}, .steps = {}}.name());
        return names;
    };
    EXPECT_EQ(read_shots_of(R"({"scene": "fence", "camera": ["a", "b"], "resolution": [[64, 36], [32, 18]]})"),
              (Names{".a.64x36", ".a.32x18", ".b.64x36", ".b.32x18"}));
    EXPECT_EQ(
        read_shots_of(R"({"scene": "fence", "frames": [[0], {"from": 2, "to": 4}]})", R"(, "resolution": [8, 4])"),
        (Names{"..8x4", "..8x4.f2-4"}));
    const std::string small = R"({"scene": "fence", "resolution": [8, 4])";
    EXPECT_EQ(read_shots_of(small + R"(, "depth_format": ["d32f", "d16"], "depth_direction": "reversed"})"),
              (Names{"..8x4.reversed", "..8x4.d16.reversed"}));
    EXPECT_EQ(read_shots_of(small + R"(, "lit": ["path_traced", "direct"], "normal_encoding": "octahedral_8"})"),
              (Names{"..8x4.octahedral_8", "..8x4.direct.octahedral_8"}));
    // What all shots of a study have is in no name; what one has in place of it is.
    EXPECT_EQ(read_shots_of(small + "}, " + small + R"(, "depth_format": "d32f"})",
                            R"(, "depth_format": "d16", "lit": "direct")"),
              (Names{"..8x4", "..8x4.d32f"}));
    const Config both = read(R"({"shots": [)" + small +
                             R"(}], "depth_format": ["d24", "d16"], "techniques": [{"technique": "none"}]})");
    ASSERT_EQ(both.shots.size(), 2u);
    EXPECT_EQ(both.shots[0].depth_format, DepthFormat::d24);
    EXPECT_EQ(both.shots[1].depth_format, DepthFormat::d16);
    EXPECT_EQ(both.shots[1].name_suffix, ".d16");
    expect_starts(mistake_in(R"({"shots": [{"scene": "fence", "depth_format": "d8"}]})"),
                  "study.json:1:31: shots[0]: 'depth_format'");
}

TEST_F(Designs, ScenesOfAFamilyAreCounted) {
    const auto scenes_of = [&](const std::string& shot) {
        Names names;
        for (const ShotConfig& s :
             read(R"({"shots": [{)" + shot + R"(}], "techniques": [{"technique": "none"}]})").shots)
            names.push_back(s.scene);
        return names;
    };
    EXPECT_EQ(scenes_of(R"("scene": "room:*", "count": 2)"), (Names{"room:0", "room:1"}));
    EXPECT_EQ(scenes_of(R"("scene": ["fence", "street:*", "room:7"], "count": 2, "first": 100)"),
              (Names{"fence", "street:100", "street:101", "room:7"}));
    const auto mistake_of = [&](const std::string& shot) {
        return mistake_in(R"({"shots": [{)" + shot + R"(}], "techniques": [{"technique": "none"}]})");
    };
    const auto says = [&](const std::string& shot, const char* text) {
        const std::string said = mistake_of(shot);
        EXPECT_NE(said.find(text), std::string::npos) << said;
    };
    says(R"("scene": "room:*")", "give their number as 'count'");
    says(R"("scene": "room:*", "count": 0)", "'count'");
    says(R"("scene": "room:*", "count": 1000000)", "'count'");
    says(R"("scene": "room:*", "count": 2, "first": 999999)", "goes beyond 999999");
    says(R"("scene": "room:1", "count": 2)", "or remove the key");
}

TEST_F(Designs, LabelsAreFilledInAndTellPointsApart) {
    const Config config =
        of(dda(R"("label": "DDA, {dda.stride} px", "group": "marches", "sweep": {"dda.stride": [1, 2]})"),
           R"({"scene": ["fence", "sky_only"], "label": "{scene} at {resolution}", "group": "g"})");
    EXPECT_EQ(config.techniques[1].label, "DDA, 2 px");
    EXPECT_EQ(config.techniques[1].group, "marches");
    EXPECT_EQ(config.shots[1].label, "sky_only at 480x270");
    EXPECT_EQ(display_name(config, "mcguire_dda", "dda.stride=2"), "DDA, 2 px");
    EXPECT_EQ(display_name(config, "none", "default"), "none");
    const std::string thickness = dda(R"("label": "{dda.thickness}", "sweep": {"dda.thickness": [0.12345678]})");
    EXPECT_EQ(of(thickness).techniques[0].label, "0.1235");
    expect_starts(mistake(dda(R"("label": "DDA", "sweep": {"dda.stride": [1, 2]})")),
                  "study.json: techniques: two points have the label 'DDA'");
    expect_starts(mistake(dda(R"("label": "DDA {dda.strid}")")),
                  "study.json:3:30: techniques[0]: 'label' names {dda.strid}");
}

/// What `ssrlab tune` would stumble over hours later is refused while the config is read.
TEST_F(Designs, SearchesAreCheckedBeforeTheyRun) {
    const auto study = [](const std::string& tune, const std::string& technique = R"({"technique": "mcguire_dda"})",
                          const std::string& more = "") {
        return R"({"shots": [{"scene": "fence"}], "metrics": ["mse"], )" + more + "\n\"techniques\": [" + technique +
               "],\n\"tune\": {" + tune + "}}";
    };
    const std::string axes =
        R"("axes": {"dda.stride": {"log": [1, 16]}, "max_roughness": [0.1, 0.6],
           "dda.refine": {"values": [false, true], "only_if": {"dda.stride": {"above": 1}}}})";
    const std::string judged =
        axes + R"(, "judge": {"shots": [{"scene": "grazing"}]}, "metrics": "mse", "budgets": [1])";
    const Config config = read(study(judged + R"(, "time": "operations", "start": "default")"));
    EXPECT_TRUE(config.is_tuned);
    EXPECT_TRUE(config.techniques.front().is_baseline);
    EXPECT_FALSE(tuning_of(config)["is_estimated"]);
    const Config estimated =
        read(study(judged + R"(, "time": "navi21")", R"({"technique": "mcguire_dda"})", R"("timing": {"frames": 0},)"));
    EXPECT_TRUE(tuning_of(estimated)["is_estimated"]);

    const auto refuses = [&](const std::string& text, const std::string& why) {
        const std::string mistake = mistake_in(text);
        EXPECT_TRUE(mistake.starts_with("study.json:")) << mistake;
        EXPECT_NE(mistake.find(why), std::string::npos) << mistake << "\nin place of " << why;
    };
    refuses(study(R"("axes": {"dda.strid": [1, 2]})"), "dda.stride");
    refuses(study(R"("axes": {"dda.stride": [1, 65]})"), "65");
    refuses(study(R"("axes": {"dda.stride": {"log": [0, 8]}})"), "'log' needs ends above 0");
    refuses(study(R"("axes": {"dda.stride": {"lin": [1, 8, 3]}})"), "must be [from, to]");
    refuses(study(R"("axes": {"dda.refine": {"values": [true], "only_if": {"dda.strid": 1}}})"), "dda.stride");
    refuses(study(R"("axes": {"dda.refine": {"values": [true], "only_if": {"shot.scene": "fence"}}})"), "not on shots");
    refuses(study(R"("axes": {"dda.refine": {"value": [true]}})"), "study.json:3:");
    refuses(study(R"("axes": {})"), "is empty");
    refuses(study(axes + R"(, "budget": [1])"), "budgets");
    refuses(study(axes + R"(, "budgets": [0])"), "'budgets' must be");
    refuses(study(axes + R"(, "time": "operation")"), "operations");
    refuses(study(axes + R"(, "time": "navi2")"), "did you mean 'navi21'?");
    refuses(study(axes + R"(, "metrics": "flip")"), "flip");
    refuses(study(axes + R"(, "start": "best")"), "best");
    refuses(study(axes + R"(, "judge": {"shots": []})"), "names no shots");
    refuses(study(axes + R"(, "judge": {"shots": [{"scene": "grazing"}], "lit": "direct"})"), "unknown key 'lit'");
    refuses(study(axes, R"({"technique": "mcguire_dda"})", R"("timing": {"frames": 0},)"), "'time' to a count");
    refuses(study(axes, R"({"technique": "mcguire_dda"}, {"technique": "none"})"), "searches one technique");
    refuses(study(axes, R"({"technique": "mcguire_dda", "timing": false})"),
            "'timing' is not allowed in a study with 'tune'");
    refuses(study(R"("axes": {"misses": ["weight"]})", R"({"technique": "amd_sssr"})", R"("seeds": 1,)"),
            "a single seed gives no interval");

    // A program's settings are its own, so that only what they look like can be checked.
    const std::string program = R"("program": ["./render.sh", "mine"], )";
    const Config over_program = read(
        study(program + R"("axes": {"steps": {"log": [8, 64]}, "blur": [true, false], "size": {"values": [1, 2]}})",
              R"({"technique": "none"}, {"technique": "mcguire_dda"})", R"("timing": {"frames": 0},)"));
    EXPECT_TRUE(over_program.techniques.front().is_baseline);
    EXPECT_EQ(tuning_of(over_program)["budgets"], json::array({1}));
    EXPECT_EQ(tuning_of(read(study(R"("program": "render", "axes": {"steps": [1]})")))["program"],
              json::array({"render"}));
    refuses(study(R"("program": [], "axes": {"steps": [1]})"), "'program'");
    refuses(study(program + R"("axes": {"steps": [1]}, "budgets": [1])"), "measures no times");
    refuses(study(program + R"("axes": {"steps": {"values": [1], "only_if": {"blur": true}}})"), "no conditions");
    refuses(study(program + R"("axes": {"steps": {"logs": [1, 2]}})"), "unknown key 'logs'");
    refuses(study(program + R"("axes": {"steps": {}})"), "exactly one of 'values', 'lin' and 'log'");
}

TEST(PointNames, StayShort) {
    EXPECT_EQ(point_name("", json::object()), "default");
    EXPECT_EQ(point_name("best", {{"a", 1}, {"b", "x"}}), "best a=1 b=x");
    json many;
    for (const char* name : {"aaaaaaaaaaaa", "bbbbbbbbbbbb", "cccccccccccc", "dddddddddddd", "eeeeeeeeeeee"})
        many[name] = 0.125;
    const std::string name = point_name("best", many);
    EXPECT_LE(name.size(), 58u);
    EXPECT_TRUE(name.starts_with("best aaaaaaaaaaaa=0.125 #")) << name;
    many["eeeeeeeeeeee"] = 0.25;
    EXPECT_NE(point_name("best", many), name);
    EXPECT_EQ(point_name("", {{"a", std::string(100, 'x')}}).size(), 58u);
    std::set<std::string> names;  // of a study as large as any
    for (int i = 0; i < 100'000; ++i) many["eeeeeeeeeeee"] = i, names.insert(point_name("best", many));
    EXPECT_EQ(names.size(), 100'000u);
}

TEST_F(Designs, WhatNoPointReadsIsNotVaried) {
    const std::string of_another = "a parameter of a tracer or denoiser that none of them uses";
    EXPECT_NE(mistake(dda(R"("sweep": {"hierarchy.depth_buffer_thickness": [0.1, 0.2]})"))
                  .find("no point reads 'hierarchy.depth_buffer_thickness', " + of_another +
                        "; did you mean 'dda.thickness'?"),
              std::string::npos);
    EXPECT_NE(mistake(dda(R"("parameters": {"tracer": "hzb"}, "each": {"dda.stride": [1, 2]})")).find(of_another),
              std::string::npos);
    // Read by some of the points, by the other of two tracers, or of no tracer.
    EXPECT_EQ(points(of(dda(R"("sweep": {"tracer": ["dda", "hzb"], "dda.stride": [1, 2]})"))).size(), 4u);
    EXPECT_EQ(points(of(dda(R"("parameters": {"tracer": "hzb"}, "sweep": {"max_roughness": [0.1, 0.2]})"))).size(), 2u);
    EXPECT_EQ(
        points(
            of(R"({"technique": "frostbite_sssr", "parameters": {"tracer": "dda", "rough_tracer": "frostbite_linear"},
                            "sweep": {"frostbite.relative_thickness": [0.01, 0.1]}})"))
            .size(),
        2u);
}
