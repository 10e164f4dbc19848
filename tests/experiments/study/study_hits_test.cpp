// The rays of a whole study: hits.csv.
#include "core/error.h"
#include "core/json.h"
#include "experiments/results/cells/study_rows.h"
#include "tests/experiments/study/study_fixture.h"

#include <map>

namespace {

/// A random technique with a few rays, one without chance, and one that has no rays.
const std::string hits_study =
    R"({"shots": [{"scene": "mirror_pillars", "resolution": [48, 27]}], "reference": {"samples": 16}, "lit": "direct",
"techniques": [{"technique": "none"}, {"technique": "mcguire_dda", "sweep": {"tracer": ["dda", "exact_scene"]}},
{"technique": "frostbite_sssr"}], "metrics": "mse", "masks": ["all", "reflective"], "timing": {"frames": 0}, "seeds": 3)";

}  // namespace

TEST_F(StudyTest, JudgesRaysWhereItIsAskedTo) {
    write_text(folder / "study.json", hits_study + R"(, "hits": {"seeds": 2}, "costs": true})");
    const std::string command = "cd '" + folder.string() + "' && SSRLAB_CACHE='" + (folder / "cache").string() +
                                "' '" SSRLAB_PROGRAM "' run study.json --out judged --replace > log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder / "log");
    const std::string hits = read_text(folder / "judged/hits.csv");
    EXPECT_TRUE(hits.starts_with("shot,frame,technique,point,stage,mask,quantity,seeds,rays,value,low,high\n"));

    std::map<std::string, double> verdicts;  // sums by point, pass and mask
    std::map<std::string, double> causes;    // of the error, likewise
    std::map<std::string, unsigned> seeds;
    for (const HitRow& r : read_rows<HitRow>(folder / "judged/hits.csv")) {
        const std::string where = r.point + " " + r.stage + " " + r.mask;
        EXPECT_EQ(r.shot, "mirror_pillars.main.48x27");
        EXPECT_NE(r.technique, "none");
        EXPECT_GT(r.rays, 0) << where;
        if (r.stage == "error") causes[where] += r.value;
        for (const char* verdict : {"right", "wrong_place", "false_hit", "avoidable_miss", "unavoidable_miss", "empty"})
            if (r.quantity == verdict) verdicts[where] += r.value;
        if (r.quantity == "correct" && r.point.find("exact_scene") != std::string::npos) {
            EXPECT_EQ(r.value, 1) << where;
        }
        if (r.quantity != "correct") continue;
        seeds[r.technique] = r.seeds;
        EXPECT_EQ(r.low.has_value(), r.technique == "frostbite_sssr") << where;
    }
    EXPECT_GE(verdicts.size(), 2u * 3) << "two masks of a pass and more for each of three points";
    // Each value is rounded to 6 digits.
    for (const auto& [where, sum] : verdicts) EXPECT_NEAR(sum, 1, 1e-5) << where;
    EXPECT_EQ(causes.size(), 2u * 3);
    for (const auto& [where, sum] : causes) EXPECT_NEAR(sum, 1, 1e-5) << where;
    EXPECT_EQ(seeds["frostbite_sssr"], 2u) << "of the point's three, as many as are asked for";
    EXPECT_EQ(seeds["mcguire_dda"], 1u) << "without chance one tells all";

    // Counted of every point but the one that uses scene data; the technique without rays only clears.
    std::map<std::string, std::map<std::string, size_t>> stages, totals;  // sums by point, quantity
    for (const CostRow& r : read_rows<CostRow>(folder / "judged/costs.csv")) {
        EXPECT_EQ(r.point.find("exact_scene"), std::string::npos);
        (r.stage == "total" ? totals : stages)[r.technique][r.quantity] += r.value;
    }
    EXPECT_EQ(totals.size(), 3u);
    EXPECT_EQ(stages, totals);
    EXPECT_EQ(totals["none"]["invocations"], 0u);
    EXPECT_EQ(totals["none"]["bytes_written"], 48u * 27 * (16 + 1)) << "radiance and confidence";
    EXPECT_EQ(totals["mcguire_dda"]["invocations"], 2 * 48u * 32);
    EXPECT_GT(totals["frostbite_sssr"]["fetches"], totals["mcguire_dda"]["fetches"]);

    size_t maps = 0;
    const nlohmann::json manifest = read_json(folder / "judged/manifest.json");
    for (const auto& image : manifest["images"]) {
        if (image["kind"] != "hits") continue;
        ++maps;
        EXPECT_TRUE(fs::exists(folder / "judged" / image["png"].get<std::string>())) << image.dump();
    }
    EXPECT_GE(maps, 3u);

    // From its cells alone.
    for (const char* file : {"hits.csv", "results.csv", "manifest.json", "report.html"})
        fs::remove(folder / "judged" / file);
    ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder / "log");
    EXPECT_EQ(read_text(folder / "judged/hits.csv"), hits);

    // Looking at rays changes no result, and is asked for. What stays of an earlier version of the study goes.
    const std::string results = read_text(folder / "judged/results.csv");
    write_text(folder / "study.json", hits_study + "}");
    ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder / "log");
    EXPECT_FALSE(fs::exists(folder / "judged/hits.csv"));
    EXPECT_EQ(read_text(folder / "judged/results.csv"), results);
}

/// The choice at random is another for each seed, of a technique without chance, too; the oracle knows the truth.
TEST_F(StudyTest, AnswersAFewRaysByTheScene) {
    write_text(folder / "study.json",
               R"({"shots": [{"scene": "mirror_pillars", "resolution": [48, 27]}], "reference": {"samples": 64},
"techniques": [{"technique": "mcguire_dda"}, {"technique": "mcguire_dda", "parameters": {"exact_share": 0.1},
"sweep": {"exact_rays": ["oracle", "random"]}}], "metrics": "mse", "masks": "reflective", "timing": {"frames": 0},
"lit": "direct", "seeds": 2, "targets": ["specular"]})");
    std::map<std::string, std::vector<double>> errors;
    for (const ResultRow& row : read_rows<ResultRow>(run(read_config(folder / "study.json"), "a") / "results.csv"))
        errors[row.point].push_back(*row.value);
    const std::vector<double>&march = errors.at("default"), &random = errors.at("exact_rays=random"),
          &oracle = errors.at("exact_rays=oracle");
    EXPECT_EQ(march.size(), 1u) << "no random number is drawn";
    ASSERT_EQ(random.size(), 2u);
    EXPECT_NE(random[0], random[1]);
    ASSERT_EQ(oracle.size(), 2u);
    for (const double error : oracle) {
        EXPECT_LT(error, 0.8 * march[0]);
        for (const double by_chance : random) EXPECT_LT(error, by_chance);
    }
}

TEST_F(StudyTest, JudgesOnePixelInEvery) {
    const auto rays_of = [&](const std::string& hits, const std::string& out) {
        write_text(folder / "study.json",
                   R"({"shots": [{"scene": "mirror_pillars", "resolution": [48, 27]}], "reference": {"samples": 16},
"techniques": [{"technique": "mcguire_dda"}], "metrics": "mse", "masks": "all", "timing": {"frames": 0}, "lit": "direct", "hits": )" +
                       hits + "}");
        for (const HitRow& r : read_rows<HitRow>(run(read_config(folder / "study.json"), out) / "hits.csv"))
            if (r.quantity == "right") return r.rays;
        return 0.0;
    };
    const double all = rays_of("{}", "all"), one_in_four = rays_of(R"({"every": 4})", "some");
    EXPECT_GT(all, 400);
    // 12 x 7 of 48 x 27 pixels; the floor's border may have a row more or less of them.
    EXPECT_NEAR(one_in_four, all * (12 * 7) / (48 * 27), 12);
}

TEST_F(StudyTest, UnknownKeysOfHitsAreRefused) {
    write_text(folder / "study.json", hits_study + R"(, "hits": {"evry": 2}})");
    EXPECT_THROW(read_config(folder / "study.json"), Error);
    write_text(folder / "study.json", hits_study + R"(, "hits": {"every": 0}})");
    EXPECT_THROW(read_config(folder / "study.json"), Error);
}
