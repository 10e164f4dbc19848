// What is timed and how: order, frames, pairs, and what leaving out saved. No test here looks at how long anything
// took.
#include "experiments/study/measuring/times/timing.h"
#include "core/gpu/device.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/measuring/times/timed_rounds.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>

namespace {

constexpr glm::uvec2 extent{64, 36};
constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Notes what is asked of the source that it hands on to.
class WatchedSource final : public FrameSource {
public:
    WatchedSource(Device& device, const Shot& shot, const Config& config)
        : source_(scene_source(device, shot, config, false)) {}

    using FrameSource::render;
    GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) override {
        steps.push_back(step);
        return source_->render(step, seed, lit);
    }
    const CameraData& camera() const override { return source_->camera(); }
    PassList& pass_list() override { return source_->pass_list(); }

    std::vector<FrameStep> steps;

private:
    std::unique_ptr<FrameSource> source_;
};

/// A machine on which each look at the counters finds 2 s gone by, and others at work as `loads` say, in turn; none
/// after the last.
struct MadeUpMachine {
    std::vector<double> loads;
    size_t looks = 0;
    double machine = 0;

    CpuTimes operator()() {
        if (looks > 0 && looks <= loads.size()) machine += loads[looks - 1] * 2 * 4;
        return {.machine = machine, .own = 0, .wall = 2.0 * double(looks++), .cpus = 4};
    }
};

struct Timing : testing::Test {
    Device device{""};
    Config config{.timing = {.frames = 15, .warm_up = 2}};
    std::set<unsigned> lit_frames;

    Timing() {
        for (const char* name : {"none", "mcguire_dda"})
            config.techniques.push_back({.technique = name, .preset = "", .point = "default", .seeds = {3}});
    }

    Shot shot(const std::string& scene, const std::vector<unsigned>& frames) {
        return load_shot({.scene = scene, .camera = "", .extent = extent, .frames = frames},
                         {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"});
    }
    ShotTimes time(FrameSource& source, const Shot& shot, bool keep_all = false, MadeUpMachine machine = {},
                   double budget = no_limit) {
        const HostImage lit(extent, 3);
        const auto lit_of = [&](unsigned frame) -> const HostImage& {
            lit_frames.insert(frame);
            return lit;
        };
        return time_techniques(
            source, shot, config, lit_of, keep_all, budget, [](double) {}, std::ref(machine));
    }
};

std::set<std::string> stages_of(const ShotTimes& times, const std::string& technique) {
    std::set<std::string> stages;
    for (const TimeRow& row : times.rows)
        if (row.technique == technique) stages.insert(row.stage);
    return stages;
}

}  // namespace

TEST_F(Timing, PlaysTheShotThereAndBack) {
    const Shot moving = shot("moving_emitter", {4, 5, 6, 9});
    WatchedSource source(device, moving, config);
    time(source, moving);
    const std::vector<unsigned> expected = {4, 5, 6, 9, 6, 5, 4, 5, 6, 9, 6, 5, 4, 5, 6, 9, 6};
    ASSERT_EQ(source.steps.size(), expected.size());
    for (unsigned i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(source.steps[i].frame, expected[i]);
        EXPECT_EQ(source.steps[i].index, i);
        EXPECT_EQ(source.steps[i].previous_frame, i > 0 ? std::optional(expected[i - 1]) : std::nullopt);
    }
    EXPECT_EQ(lit_frames, (std::set<unsigned>{4, 5, 6, 9}));
}

TEST(TimedSteps, HoldASingleFrame) {
    for (const FrameStep& step : timed_steps({7}, 5)) EXPECT_EQ(step.frame, 7u);
    EXPECT_EQ(timed_steps({7}, 5).back().index, 4u);
    const std::vector<FrameStep> two = timed_steps({7, 8}, 4);
    EXPECT_EQ(two[2].frame, 7u);
    EXPECT_EQ(two[3].frame, 8u);
}

TEST(TimedTurns, GiveEachCopyEachPlaceAlike) {
    const size_t count = 6;
    const unsigned rounds = 6000;
    std::vector<unsigned> at(count * count);
    for (const std::vector<size_t>& order : timed_turns(count, rounds)) {
        ASSERT_EQ(std::set(order.begin(), order.end()).size(), count);
        for (size_t place = 0; place < count; ++place) ++at[order.at(place) * count + place];
    }
    // Binomial: 1000 +- 29; five deviations. The run is the same each time.
    for (const unsigned times : at) EXPECT_NEAR(times, 1000, 145);
    EXPECT_EQ(timed_turns(4, 9), timed_turns(4, 9));
}

TEST_F(Timing, GivesEveryStageOfEveryMeasuredFrameAndTheirSum) {
    const Shot still = shot("fence", {0});
    WatchedSource source(device, still, config);
    const ShotTimes times = time(source, still);
    EXPECT_EQ(stages_of(times, "mcguire_dda"),
              (std::set<std::string>{"mcguire_dda/shade", "mcguire_dda/trace", "total"}));
    EXPECT_FALSE(stages_of(times, "").empty()) << "the G-buffer's own stages";
    std::map<std::pair<std::string, unsigned>, double> sums;
    std::map<std::pair<std::string, std::string>, unsigned> counts;
    for (const TimeRow& row : times.rows) {
        EXPECT_LT(row.frame, 15u);
        EXPECT_EQ(row.shot, still.name());
        EXPECT_EQ(row.seed, row.technique.empty() ? 0u : 3u);
        ++counts[{row.technique, row.stage}];
        if (!row.technique.empty())
            sums[{row.technique, row.frame}] += row.stage == "total" ? -row.milliseconds : row.milliseconds;
    }
    for (const auto& [stage, count] : counts) EXPECT_EQ(count, 15u) << stage.first << " " << stage.second;
    // On a GPU the total is the frame's envelope, which holds the gaps between the stages too.
    if (source.pass_list().clock() == Clock::gpu_timestamp) return;
    for (const auto& [frame, difference] : sums) EXPECT_NEAR(difference, 0.0, 1e-9) << "ms: the rounding of a sum";
}

TEST_F(Timing, RepeatsFramesThatOthersDisturbed) {
    const Shot still = shot("fence", {0});
    WatchedSource source(device, still, config);
    // Each round is a window of its own: the 3rd and the 5th are disturbed, a load at the threshold is none.
    const ShotTimes times = time(source, still, false, {.loads = {0, 0.05, 0.3, 0, 0.06, 0.01}});
    EXPECT_EQ(source.steps.size(), 2u + 15u + 2u);
    std::set<unsigned> frames;
    for (const TimeRow& row : times.rows) {
        frames.insert(row.frame);
        EXPECT_FALSE(row.disturbed);
        EXPECT_NEAR(row.foreign_load.value(), row.frame == 1 ? 0.05 : row.frame == 5 ? 0.01 : 0.0, 1e-12);
    }
    EXPECT_EQ(frames, (std::set<unsigned>{0, 1, 3, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
    EXPECT_EQ(times.load.disturbed, 0u);
    EXPECT_EQ(times.load.left_out, 2u);
    EXPECT_NEAR(times.load.largest.value(), 0.05, 1e-12);
}

TEST_F(Timing, MarksWhatItCannotRepeat) {
    const Shot still = shot("fence", {0});
    WatchedSource source(device, still, config);
    MadeUpMachine busy{.loads = std::vector<double>(100, 0.5)};
    busy.loads[7] = 0, busy.loads[20] = 0.2;
    const ShotTimes times = time(source, still, false, busy);
    EXPECT_EQ(source.steps.size(), 2u + (1 + most_repeated_frames) * 15u) << "and no more";
    std::map<unsigned, bool> disturbed;
    for (const TimeRow& row : times.rows) disturbed[row.frame] = row.disturbed;
    ASSERT_EQ(disturbed.size(), 15u);
    EXPECT_FALSE(disturbed.at(7));
    EXPECT_TRUE(disturbed.at(20)) << "the least disturbed come first";
    EXPECT_EQ(times.load.disturbed, 14u);
    EXPECT_EQ(times.load.left_out, 30u);
    EXPECT_EQ(times.load.largest, 0.5);
    EXPECT_NEAR(disturbed_share(timing_entry(times, "a", {})), 14.0 / 15, 1e-12);
    EXPECT_EQ(disturbed_share({}), 0.0) << "nothing was timed";
    for (const TimeSummary& summary : summarise(times.rows)) {
        EXPECT_EQ(summary.frames, 15u);
        EXPECT_NEAR(summary.disturbed_share, 14.0 / 15, 1e-12);
    }
}

TEST_F(Timing, LeavesOutDisturbedFramesIfOthersAreEnough) {
    const Shot still = shot("fence", {0});
    WatchedSource source(device, still, config);
    MadeUpMachine busy{.loads = std::vector<double>(100, 0.5)};
    std::fill_n(busy.loads.begin() + 2, least_rounds, 0.0);
    // Each look at the counters is 2 s later, so that few frames come after those; warming up takes a part of it, too.
    const ShotTimes times = time(source, still, false, busy, 60);
    EXPECT_GT(source.steps.size(), 2u + 2u + least_rounds);
    EXPECT_LE(source.steps.size(), 2u + 30u) << "repeated without an end";
    std::set<unsigned> frames;
    for (const TimeRow& row : times.rows) frames.insert(row.frame);
    EXPECT_EQ(frames, (std::set<unsigned>{2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(times.load.frames, least_rounds);
    EXPECT_EQ(times.load.disturbed, 0u);
    EXPECT_EQ(times.load.left_out, source.steps.size() - 2u - least_rounds);
}

TEST_F(Timing, TakesTheLeastWhereThereIsNoTime) {
    for (const int stride : {2, 4})
        config.techniques.push_back({.technique = "mcguire_dda",
                                     .preset = "",
                                     .parameters = {{"dda.stride", stride}},
                                     .point = "dda.stride=" + std::to_string(stride),
                                     .seeds = {3}});
    const Shot rough = shot("all_rough", {0});  // of which techniques leave something out
    WatchedSource source(device, rough, config);
    const ShotTimes least = time(source, rough, false, {}, 0);
    EXPECT_EQ(source.steps.size(), 2u + least_rounds);
    const auto rows_of = [](const ShotTimes& times, const std::string& point) {
        return std::ranges::count_if(times.rows, [&](const TimeRow& row) {
            return row.technique == "mcguire_dda" && row.point == point && row.stage == "total";
        });
    };
    for (const char* point : {"default", "dda.stride=2", "dda.stride=4"})
        EXPECT_EQ(rows_of(least, point), least_rounds);
    EXPECT_EQ(least.pairs.size(), 3u) << "one of each technique, three at least";
    EXPECT_EQ(least.savings.size(), 1u) << "one of each technique that leaves anything out";
    EXPECT_EQ(least.saved.size(), 2u) << "of every stage";

    const ShotTimes all = time(source, rough);
    for (const char* point : {"default", "dda.stride=2", "dda.stride=4"}) EXPECT_EQ(rows_of(all, point), 15);
    EXPECT_EQ(all.pairs.size(), 4u);
    EXPECT_EQ(all.savings.size(), 3u);
}

TEST_F(Timing, TakesTimesWhereLoadCannotBeTold) {
    const Shot still = shot("fence", {0});
    WatchedSource source(device, still, config);
    const auto lit = [image = HostImage(extent, 3)](unsigned) -> const HostImage& { return image; };
    const ShotTimes times = time_techniques(
        source, still, config, lit, false, no_limit, [](double) {}, [] { return CpuTimes{}; });
    EXPECT_EQ(source.steps.size(), 17u);
    for (const TimeRow& row : times.rows) EXPECT_FALSE(row.foreign_load || row.disturbed);
    EXPECT_FALSE(times.load.largest);
}

TEST_F(Timing, PairsEveryTimedPointAndLeavesOutTheOthers) {
    config.techniques.push_back({.technique = "mcguire_dda",
                                 .preset = "",
                                 .parameters = {{"dda.stride", 4}},
                                 .point = "dda.stride=4",
                                 .seeds = {3},
                                 .is_timed = false});
    const Shot still = shot("fence", {0});
    WatchedSource source(device, still, config);
    const ShotTimes times = time(source, still);
    ASSERT_EQ(times.pairs.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(times.pairs[i].technique, config.techniques[i].technique);
        EXPECT_GT(times.pairs[i].first_ms, 0.0);
        EXPECT_GT(times.pairs[i].second_ms, 0.0);
        EXPECT_NE(times.pairs[i].first_ms, times.pairs[i].second_ms) << "measured once, reported twice";
    }
    EXPECT_TRUE(std::ranges::none_of(times.rows, [](const TimeRow& row) { return row.point == "dda.stride=4"; }));

    for (PointConfig& technique : config.techniques) technique.is_timed = false;
    EXPECT_TRUE(time(source, still).rows.empty());
}

TEST_F(Timing, MeasuresWhatLeavingOutSaved) {
    const Shot rough = shot("all_rough", {0});
    WatchedSource source(device, rough, config);
    const ShotTimes lean = time(source, rough), all = time(source, rough, true);
    EXPECT_FALSE(stages_of(lean, "mcguire_dda").contains("mcguire_dda/trace"));
    EXPECT_TRUE(stages_of(all, "mcguire_dda").contains("mcguire_dda/trace"));
    ASSERT_EQ(lean.saved.size(), 2u);
    EXPECT_EQ(lean.saved[0].stage, "mcguire_dda/shade");
    EXPECT_EQ(lean.saved[1].stage, "mcguire_dda/trace");
    for (const SavedTime& saved : lean.saved) EXPECT_GT(saved.milliseconds, 0.0);
    EXPECT_TRUE(all.saved.empty());
    ASSERT_EQ(lean.savings.size(), 1u);
    const Saving& saving = lean.savings.front();
    EXPECT_EQ(saving.technique, "mcguire_dda");
    EXPECT_GT(saving.complete_ms, 0.0);
    EXPECT_LE(saving.share.low, saving.share.value);
    EXPECT_LT(saving.share.high, 1.0);
    EXPECT_TRUE(all.savings.empty());

    config.timing.has_copies = false;
    const ShotTimes alone = time(source, rough);
    EXPECT_EQ(alone.rows.size(), lean.rows.size());
    EXPECT_TRUE(alone.pairs.empty() && alone.saved.empty() && alone.savings.empty());
    config.timing.has_copies = true;

    const Shot mirrors = shot("fence", {0});
    WatchedSource mirror_source(device, mirrors, config);
    EXPECT_TRUE(time(mirror_source, mirrors).saved.empty());
}

/// Of copies whose times differ by 2 % (heavy tails), a floor that covers 95 % of the next pairs, however many there
/// are.
TEST(TimingEntry, HasAFloorThatDoesNotGrowWithThePairs) {
    const ClockProof clock{.method = "host_fence", .empty_submit_ms = 0.1, .checks = {}};
    std::mt19937 random(3);
    std::student_t_distribution<double> noise(4);
    std::vector<double> medians;
    for (const size_t count : {1, 13, 52}) {
        std::vector<double> floors;
        for (int study = 0; study < 401; ++study) {
            ShotTimes times;
            for (size_t i = 0; i < count; ++i)
                times.pairs.push_back({"v", std::to_string(i), 10.0, 10.0 * (1 + 0.02 * noise(random))});
            nlohmann::json manifest = {{"clock", nlohmann::json::object()}, {"shots", nlohmann::json::array()}};
            add_timing(manifest, timing_entry(times, "a", clock));
            floors.push_back(manifest["clock"]["aa_floors"]["a"]);
        }
        std::ranges::nth_element(floors, floors.begin() + 200);
        medians.push_back(floors[200]);
    }
    // 95 % of |t| with 4 degrees of freedom lie below 2.78, and of a normal variable with its median below 2.15: 0.055
    // and 0.043. The median of 401 floors is known to 15 % for a single pair, and to 5 % for more.
    for (const double median : medians) {
        EXPECT_GT(median, 0.85 * 0.043);
        EXPECT_LT(median, 1.1 * 0.055) << "the largest of 52 would be 0.12";
    }
}

TEST(TimingEntry, GoesIntoTheManifest) {
    const ClockProof clock{.method = "host_fence", .empty_submit_ms = 0.1, .checks = {}};
    nlohmann::json manifest = {
        {"clock", nlohmann::json::object()},
        {"shots",
         {{{"shot", "a"},
           {"left_out",
            {{{"what", "v/trace"}, {"stage", "v/trace"}, {"saved_ms", nullptr}},
             {{"what", "alpha tests"}, {"stage", "alpha tests"}, {"saved_ms", nullptr}}}}},
          {{"shot", "b"}, {"left_out", {{{"what", "v/trace"}, {"stage", "v/trace"}, {"saved_ms", nullptr}}}}}}}};
    ShotTimes times;
    times.pairs = {{"none", "default", 0.2, 0.3}, {"v", "default", 9.5, 10.5}};
    times.saved = {{"v/trace", 2.5}};
    times.savings = {{"v", "default", 20.0, {0.25, 0.2, 0.3}}};
    add_timing(manifest, timing_entry(times, "a", clock));
    // The pair of `none` differs by 40 %, but takes only two and three times what an empty submission does.
    EXPECT_NEAR(manifest["clock"]["aa_floors"]["a"].get<double>(), 0.1 * 1.96 / 0.6745, 1e-4);
    EXPECT_EQ(manifest["clock"]["aa_pairs"].size(), 2u);
    EXPECT_EQ(manifest["clock"]["savings"][0]["share"], 0.25);
    EXPECT_EQ(manifest["shots"][0]["left_out"][0]["saved_ms"], 2.5);
    EXPECT_TRUE(manifest["shots"][0]["left_out"][1]["saved_ms"].is_null());
    EXPECT_TRUE(manifest["shots"][1]["left_out"][0]["saved_ms"].is_null()) << "another shot";

    times.pairs = {{"v", "default", 18.0, 22.0}}, times.saved = {};
    add_timing(manifest, timing_entry(times, "b", clock));
    EXPECT_NEAR(manifest["clock"]["aa_floors"]["b"].get<double>(), 0.2 * 1.96 / 0.6745, 1e-4);
    EXPECT_NEAR(manifest["clock"]["aa_floors"]["a"].get<double>(), 0.1 * 1.96 / 0.6745, 1e-4) << "a shot's own";
    EXPECT_EQ(manifest["clock"]["aa_pairs"].size(), 3u);
    EXPECT_EQ(manifest["clock"]["aa_pairs"][2]["shot"], "b");
    ASSERT_EQ(manifest["clock"]["proofs"].size(), 1u) << "one clock, proven once";
    EXPECT_EQ(manifest["clock"]["proofs"][0]["shots"], nlohmann::json({"a", "b"}));
    const ClockProof another{.method = "host_fence", .empty_submit_ms = 0.2, .checks = {}};
    add_timing(manifest, timing_entry(times, "c", another));
    EXPECT_EQ(manifest["clock"]["proofs"].size(), 2u);
    EXPECT_EQ(manifest["clock"]["load"].size(), 3u);

    nlohmann::json of_points_alone = {{"shots", nlohmann::json::array()}};
    add_timing(of_points_alone, timing_entry(ShotTimes{}, "a", clock));
    EXPECT_FALSE(of_points_alone["clock"].contains("aa_floors")) << "a noise of 0 would be a claim";
}
