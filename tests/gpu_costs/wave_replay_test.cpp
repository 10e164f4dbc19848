#include "experiments/gpu_costs/waves/wave_replay.h"
#include "core/error.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <random>

namespace {

/// A lane's decisions as they are made.
struct Decisions {
    std::vector<uint32_t> words = std::vector<uint32_t>(64, 0);
    uint64_t count = 0;

    void add(bool bit) {
        if (bit && count / 32 < words.size()) words[count / 32] |= 1u << count % 32;
        ++count;
    }
    LaneTrace trace() const { return {.has_run = true, .decisions = count, .words = words}; }
};

WaveCounts replayed(const ShaderFlow& flow, const std::vector<Decisions>& lanes, unsigned width) {
    std::vector<LaneTrace> traces;
    for (const Decisions& lane : lanes) traces.push_back(lane.trace());
    return replay(flow, traces, width);
}

/// 0; while (decision 1) { while (decision 2) 3; 4 } 5. Reconvergence: the block behind each loop.
const ShaderFlow nested_loops{{{.label = 0, .successors = {1}, .rank = 0},
                               {.label = 1, .successors = {2, 5}, .decisions = 1, .rank = 1, .is_loop_header = true},
                               {.label = 2, .successors = {3, 4}, .decisions = 1, .rank = 2, .is_loop_header = true},
                               {.label = 3, .successors = {2}, .rank = 3},
                               {.label = 4, .successors = {1}, .rank = 4},
                               {.label = 5, .rank = 5}}};

}  // namespace

/// A wave takes as many turns of a loop as its busiest lane, in each turn of an outer loop anew.
TEST(WaveReplay, LoopsTakeAsLongAsTheBusiestLane) {
    std::mt19937 random(1);
    const auto number = [&](int most) { return std::uniform_int_distribution(0, most)(random); };
    std::vector<std::vector<int>> turns(96);  // by lane: inner turns of each outer one
    std::vector<Decisions> lanes(turns.size());
    for (size_t lane = 0; lane < turns.size(); ++lane) {
        turns[lane].resize(size_t(number(6)));
        for (int& inner : turns[lane]) {
            inner = number(9);
            lanes[lane].add(true);
            for (int i = 0; i < inner; ++i) lanes[lane].add(true);
            lanes[lane].add(false);
        }
        lanes[lane].add(false);
    }
    for (const size_t width : {1u, 8u, 32u, 64u}) {
        uint64_t outer_turns = 0, inner_turns = 0, waves = 0, lane_turns = 0;
        for (size_t first = 0; first < turns.size(); first += width, ++waves) {
            const size_t end = std::min(first + width, turns.size());
            size_t longest = 0;
            for (size_t lane = first; lane < end; ++lane) longest = std::max(longest, turns[lane].size());
            outer_turns += longest;
            for (size_t turn = 0; turn < longest; ++turn) {
                int most = 0;
                for (size_t lane = first; lane < end; ++lane)
                    if (turn < turns[lane].size()) {
                        most = std::max(most, turns[lane][turn]);
                        lane_turns += uint64_t(turns[lane][turn]);
                    }
                inner_turns += uint64_t(most);
            }
        }
        const WaveCounts counts = replayed(nested_loops, lanes, unsigned(width));
        EXPECT_EQ(counts.waves, (std::vector<uint64_t>{waves, outer_turns + waves, inner_turns + outer_turns,
                                                       inner_turns, outer_turns, waves}))
            << width;
        EXPECT_EQ(counts.lanes[3], lane_turns) << width;
        EXPECT_EQ(counts.started, waves) << width;
        EXPECT_EQ(counts.cut, 0u);
    }
}

/// A switch of two cases and a default, one of which ends the lane: the wave goes each way that one of its lanes takes,
/// and only what is left goes on.
TEST(WaveReplay, WavesGoEachWayThatALaneTakes) {
    const ShaderFlow flow{{{.label = 0, .successors = {1, 2, 3}, .decisions = 2, .rank = 0},
                           {.label = 1, .successors = {4}, .rank = 1},
                           {.label = 2, .rank = 2},
                           {.label = 3, .successors = {4}, .rank = 3},
                           {.label = 4, .rank = 4}}};
    const auto lane = [](int way) {
        Decisions decisions;
        decisions.add(way == 0), decisions.add(way == 1);
        return decisions;
    };
    EXPECT_EQ(replayed(flow, {lane(0), lane(1), lane(2), lane(2)}, 4).waves, (std::vector<uint64_t>{1, 1, 1, 1, 1}));
    EXPECT_EQ(replayed(flow, {lane(2), lane(2)}, 4).waves, (std::vector<uint64_t>{1, 0, 0, 1, 1}));
    EXPECT_EQ(replayed(flow, {lane(1)}, 4).waves, (std::vector<uint64_t>{1, 0, 1, 0, 0}));
}

/// A loop whose branch has a way out of the loop in both of its arms: those that stay go on together in each turn, as
/// the sets of lanes in the test below say, though the branch's nearest post-dominator is the end of the loop.
TEST(WaveReplay, LanesMeetAtTheEndOfATurnThoughOthersLeftTheLoop) {
    const ShaderFlow flow{{{.label = 0, .successors = {1}, .rank = 0},
                           {.label = 1, .successors = {2, 3}, .decisions = 1, .rank = 1, .is_loop_header = true},
                           {.label = 2, .successors = {5, 4}, .decisions = 1, .rank = 2},
                           {.label = 3, .successors = {5, 4}, .decisions = 1, .rank = 3},
                           {.label = 4, .successors = {1}, .rank = 4},
                           {.label = 5, .rank = 5}}};
    std::mt19937 random(2);
    std::vector<Decisions> lanes(64);
    std::vector<std::vector<bool>> arms(lanes.size());  // by lane: in each turn, whether it takes the first
    for (size_t lane = 0; lane < lanes.size(); ++lane) {
        arms[lane].resize(1 + random() % 20);
        for (size_t turn = 0; turn < arms[lane].size(); ++turn) {
            arms[lane][turn] = random() % 2;
            lanes[lane].add(arms[lane][turn]);
            lanes[lane].add(turn + 1 == arms[lane].size());
        }
    }
    std::vector<uint64_t> expected = {1, 0, 0, 0, 0, 1};
    for (size_t turn = 0; turn < 20; ++turn) {
        bool has_first = false, has_second = false, has_next = false;
        for (const std::vector<bool>& lane : arms) {
            if (turn >= lane.size()) continue;
            (lane[turn] ? has_first : has_second) = true;
            has_next = has_next || turn + 1 < lane.size();
        }
        expected[1] += has_first || has_second, expected[2] += has_first, expected[3] += has_second;
        expected[4] += has_next;
    }
    EXPECT_EQ(replayed(flow, lanes, 64).waves, expected);
}

TEST(WaveReplay, LanesWithoutARecordDoNotRunAndLongOnesAreCut) {
    std::vector<Decisions> lanes(2);
    for (int i = 0; i < 64 * 32 + 10; ++i) lanes[0].add(true);  // more than a record holds
    std::vector<LaneTrace> traces = {lanes[0].trace(), {.has_run = false, .decisions = 0, .words = {}}};
    const WaveCounts counts = replay(nested_loops, traces, 32);
    EXPECT_EQ(counts.started, 1u);
    EXPECT_EQ(counts.cut, 1u);
    EXPECT_EQ(counts.lanes[0], 1u);
    EXPECT_EQ(counts.lanes[1] + counts.lanes[2], 64u * 32 + 1)
        << "each decision that is known, and the one that is not";
    EXPECT_THROW(replay(nested_loops, traces, 65), Error);
}
