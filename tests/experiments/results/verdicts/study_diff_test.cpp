// What counts as a change from one study to another, and how often two runs of one program have one.
#include "experiments/results/verdicts/study_diff.h"

#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/diff_command.h"
#include "experiments/results/evaluation.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/study_points.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

using nlohmann::json;

constexpr unsigned frames = 15;

/// A study of one error of made-up points, as `ssrlab run` would leave it.
struct MadeUpStudy {
    std::vector<ResultRow> rows;
    std::vector<TimeRow> times;
    json manifest = {{"clock", {{"aa_floors", json::object()}, {"aa_pairs", json::array()}, {"load", json::array()}}},
                     {"shots", json::array()},
                     {"techniques", json::array()},
                     {"provenance", {{{"host", {{"name", "h"}, {"cpu", "c"}}}, {"device", {{"name", "d"}}}}}}};

    void add_shot(const std::string& shot, const std::string& truth, double floor = 0.02, int pairs = 12) {
        manifest["shots"].push_back(
            {{"shot", shot}, {"references", {{{"hash", truth}, {"relative_error", {{"mean", 0.1}}}, {"rays", 7}}}}});
        manifest["clock"]["aa_floors"][shot] = floor;
        for (int i = 0; i < pairs; ++i) manifest["clock"]["aa_pairs"].push_back({{"shot", shot}});
    }

    void add(const std::string& shot, const std::string& technique, unsigned seed, double value) {
        ResultRow r{.shot = shot, .frame = "0", .technique = technique, .point = "p", .seed = seed};
        r.target = "specular", r.metric = r.formula = "mse", r.mask = "all", r.value = value;
        r.floor = 0, r.represents_shot = true;  // against an exact reference: seeds are all that is random
        rows.push_back(r);
    }

    void add_times(const std::string& shot, const std::string& technique, std::vector<double> milliseconds) {
        for (unsigned f = 0; f < milliseconds.size(); ++f)
            times.push_back({shot, technique, "p", 0, "total", f, milliseconds[f], "host_fence"});
    }

    StudyResults measured() const {
        StudyResults made;
        made.manifest = manifest, made.results = rows, made.times = times;
        return made;
    }

    StudyResults tables() const {
        std::map<std::string, double> floors;
        const json of_shots = manifest["clock"].value("aa_floors", json::object());
        for (const auto& [shot, floor] : of_shots.items()) floors[shot] = floor;
        StudyResults made = measured();
        made.summary = summarise(rows, points_without_seeds(manifest)), made.time_summary = summarise(times, floors);
        return made;
    }

    void write(const std::filesystem::path& folder) const {
        write_text(folder / "manifest.json", manifest.dump());
        StudyResults made = measured();
        evaluate(made, {}, {});
        write_tables(folder, made);
    }
};

const std::string shots[] = {"s0", "s1", "s2", "s3"};

/// Log-normal seeds of deviation `spread`: with 1, single ones of ten times the median, as fireflies make them.
double noisy(std::mt19937& random, double mean, double spread) {
    return mean * std::exp(std::normal_distribution<double>(-spread * spread / 2, spread)(random));
}

MadeUpStudy study_of(std::mt19937& random, unsigned first_seed, const std::string& truth, unsigned seeds = 4,
                     double spread = 1) {
    MadeUpStudy study;
    std::student_t_distribution<double> jitter(3);
    for (const std::string& shot : shots) {
        study.add_shot(shot, truth);
        for (int v = 0; v < 12; ++v) {
            for (unsigned seed = 0; seed < seeds; ++seed)
                study.add(shot, "v" + std::to_string(v), first_seed + seed, noisy(random, 1 + v, spread));
            // What two copies of a point differ by, 2 % in 95 % of pairs: deviation 0.01 of their difference.
            const double of_run = std::exp(0.01 / std::sqrt(2.0) * std::normal_distribution<double>()(random));
            std::vector<double> milliseconds;
            for (unsigned f = 0; f < frames; ++f)
                milliseconds.push_back((1 + v) * of_run * std::exp(0.01 * jitter(random)));
            study.add_times(shot, "v" + std::to_string(v), milliseconds);
        }
    }
    return study;
}

size_t changed(const StudyDiff& diff) {
    return count_of(diff.errors, change::changed) + count_of(diff.times, change::changed);
}

}  // namespace

TEST(StudyDiff, FindsNoChangeInItself) {
    std::mt19937 random(1);
    const StudyResults study = study_of(random, 1, "t").tables();
    const StudyDiff diff = diff_studies(study, study, true);
    EXPECT_EQ(count_of(diff.errors, change::equal), diff.errors.size());
    EXPECT_EQ(count_of(diff.times, change::equal), diff.times.size());
    EXPECT_EQ(diff.errors.size(), 48u);
}

/// Two runs of one program with other seeds and another reference, on heavy tails, times included.
TEST(StudyDiff, SaysAChangeOfOneProgramInFivePercentAtMost) {
    std::mt19937 random(2);
    constexpr int pairs = 400;
    for (const unsigned seeds : {4u, 8u}) {
        int alarms = 0;
        for (int pair = 0; pair < pairs; ++pair) {
            const StudyResults before = study_of(random, 1, "t", seeds).tables(),
                               after = study_of(random, 101, "u", seeds).tables();
            alarms += changed(diff_studies(before, after, true)) > 0;
        }
        // 400 pairs of exactly 5 % exceed 8.5 % with a probability of 0.002.
        EXPECT_LT(alarms, 0.085 * pairs) << seeds << " seeds";
        RecordProperty("alarms_of_400_with_" + std::to_string(seeds) + "_seeds", alarms);
    }
}

TEST(StudyDiff, FindsASmallEditByPairsOfSeeds) {
    std::mt19937 random(3);
    const MadeUpStudy before = study_of(random, 1, "t");
    MadeUpStudy after = before;
    for (ResultRow& r : after.rows)  // far below the scatter of the seeds
        if (r.technique == "v3") *r.value += 0.01 + 0.0001 * std::normal_distribution<double>()(random);
    const StudyDiff diff = diff_studies(before.tables(), after.tables(), false);
    for (const NumberChange& c : diff.errors)
        EXPECT_EQ(c.verdict, c.technique == "v3" ? change::changed : change::equal) << c.shot << c.technique;
}

TEST(StudyDiff, TakesRoundingForNone) {
    std::mt19937 random(4);
    const MadeUpStudy before = study_of(random, 1, "t");
    for (const auto& [relative, verdict] : {std::pair(1e-8, change::equal), std::pair(1e-4, change::changed)}) {
        MadeUpStudy one = before, other = before;
        for (MadeUpStudy* study : {&one, &other}) {
            study->rows.clear();
            study->manifest["techniques"] = {{{"technique", "exact"}, {"point", "p"}, {"depends_on_seed", false}}};
        }
        one.add("s0", "exact", 0, 0.5), other.add("s0", "exact", 0, 0.5 * (1 + relative));
        EXPECT_EQ(diff_studies(one.tables(), other.tables(), false).errors.front().verdict, verdict);
    }
}

TEST(StudyDiff, FindsThreeTimesTheErrorAgainstAnotherTruth) {
    std::mt19937 random(5);
    const MadeUpStudy before = study_of(random, 1, "t", 8, 0.1);
    MadeUpStudy after = study_of(random, 101, "u", 8, 0.1);
    for (ResultRow& r : after.rows)
        if (r.technique == "v5" && r.shot == "s1") *r.value *= 3;
    const StudyDiff diff = diff_studies(before.tables(), after.tables(), false);
    ASSERT_EQ(count_of(diff.errors, change::changed), 1u);
    EXPECT_EQ(std::ranges::find(diff.errors, change::changed, &NumberChange::verdict)->technique, "v5");
}

TEST(StudyDiff, DoesNotJudgeWhatIsNotRanked) {
    std::mt19937 random(6);
    StudyResults before = study_of(random, 1, "t", 8, 0.1).tables(),
                 after = study_of(random, 101, "u", 8, 0.1).tables();
    for (MetricSummary& e : after.summary) *e.value *= 3, e.ranked = false;
    const StudyDiff diff = diff_studies(before, after, false);
    EXPECT_EQ(count_of(diff.errors, change::not_judged), diff.errors.size());
}

TEST(StudyDiff, ComparesTimesOfOneMachineAlone) {
    std::mt19937 random(7);
    const MadeUpStudy before = study_of(random, 1, "t");
    MadeUpStudy slower = before, nearly = before;
    for (TimeRow& t : slower.times) t.milliseconds *= 1.5;
    for (TimeRow& t : nearly.times) t.milliseconds *= 1.015;
    EXPECT_EQ(count_of(diff_studies(before.tables(), slower.tables(), true).times, change::changed), 48u);
    EXPECT_EQ(count_of(diff_studies(before.tables(), nearly.tables(), true).times, change::changed), 0u)
        << "copies of one point differ by more";
    slower.manifest["clock"]["load"].push_back({{"shot", "s0"}, {"host", {{"name", "other"}, {"cpu", "c"}}}});
    const StudyDiff moved = diff_studies(before.tables(), slower.tables(), true);
    ASSERT_EQ(moved.moved.size(), 1u);
    EXPECT_EQ(moved.moved.front().after, "other (c), d");
    EXPECT_EQ(moved.times.size(), 36u);
    for (TimeRow& t : slower.times) t.disturbed = true;
    EXPECT_EQ(count_of(diff_studies(before.tables(), slower.tables(), true).times, change::not_judged), 36u);
    slower.manifest["clock"].erase("aa_floors");
    StudyResults unknown = slower.tables();
    for (TimeSummary& t : unknown.time_summary) t.disturbed_share = 0;
    EXPECT_EQ(diff_studies(before.tables(), unknown, true).times.front().how, "no point was timed twice");
}

TEST(DiffCommand, ExitsWithOneForAChangeAlone) {
    const auto place = std::filesystem::temp_directory_path() / "diff_test";
    std::filesystem::remove_all(place);
    std::mt19937 random(8);
    const MadeUpStudy study = study_of(random, 1, "t");
    MadeUpStudy edited = study, slower = study, fewer = study, another = study;
    for (ResultRow& r : edited.rows) *r.value += 0.5 + 0.001 * r.seed;
    for (TimeRow& t : slower.times) t.milliseconds *= 1.5;
    std::erase_if(fewer.rows, [](const ResultRow& r) { return r.technique == "v1"; });
    for (ResultRow& r : another.rows) r.shot = "elsewhere";
    const std::pair<const char*, const MadeUpStudy*> folders[] = {
        {"study", &study}, {"edited", &edited}, {"slower", &slower}, {"fewer", &fewer}, {"another", &another}};
    for (const auto& [name, made] : folders) {
        std::filesystem::create_directories(place / name);
        made->write(place / name);
    }
    const auto diff = [&](const char* name, bool judges_times = false) {
        testing::internal::CaptureStdout();
        int code = -1;
        try {
            code = diff_command({.before = place / "study",
                                 .after = place / name,
                                 .csv = place / "diff.csv",
                                 .judges_times = judges_times});
        } catch (const Error& e) {
            return std::pair(2, testing::internal::GetCapturedStdout() + e.what());
        }
        return std::pair(code, testing::internal::GetCapturedStdout());
    };
    EXPECT_EQ(diff("study").first, 0);
    EXPECT_EQ(diff("edited").first, 1);
    EXPECT_EQ(read_rows<NumberChange>(place / "diff.csv").size(), 96u) << "errors and times";
    EXPECT_EQ(diff("slower").first, 0) << "times count where they are asked for";
    EXPECT_EQ(diff("slower", true).first, 1);
    const auto [code, said] = diff("fewer");
    EXPECT_EQ(code, 0) << "points of one study alone are no change";
    EXPECT_NE(said.find("study alone, and not compared: 4 points of shots"), std::string::npos) << said;
    EXPECT_EQ(diff("another").first, 2) << "nothing in common";

    // Folders of an older version, or half of one: a sentence, never a verdict.
    json old = study.manifest;
    old["written"] = {{"ssrlab", {{"commit", "abc1234"}}}};
    write_text(place / "edited/manifest.json", old.dump());
    write_text(place / "edited/summary.csv", "shot,frame,technique,point,value\n");
    const std::string complaint = diff("edited").second;
    for (const char* words : {"ssrlab of commit abc1234 wrote the folder", "summary.csv has no column", "`ssrlab run`"})
        EXPECT_NE(complaint.find(words), std::string::npos) << complaint;
    std::filesystem::remove(place / "slower/time_summary.csv");
    EXPECT_NE(diff("slower").second.find("time_summary.csv is missing"), std::string::npos);
    std::filesystem::remove(place / "fewer/manifest.json");
    EXPECT_NE(diff("fewer").second.find("is no results folder"), std::string::npos);
    std::filesystem::remove_all(place);
}
