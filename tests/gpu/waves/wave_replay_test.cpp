#include "core/gpu/waves/wave_replay.h"
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
const ShaderFlow nested_loops{
    {{.label = 0, .successors = {1}, .reconvergence = 1},
     {.label = 1, .successors = {2, 5}, .decisions = 1, .reconvergence = 5, .is_loop_header = true},
     {.label = 2, .successors = {3, 4}, .decisions = 1, .reconvergence = 4, .is_loop_header = true},
     {.label = 3, .successors = {2}, .reconvergence = 2},
     {.label = 4, .successors = {1}, .reconvergence = 1},
     {.label = 5, .reconvergence = 6}}};

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
    const ShaderFlow flow{{{.label = 0, .successors = {1, 2, 3}, .decisions = 2, .reconvergence = 5},
                           {.label = 1, .successors = {4}, .reconvergence = 4},
                           {.label = 2, .reconvergence = 5},
                           {.label = 3, .successors = {4}, .reconvergence = 4},
                           {.label = 4, .reconvergence = 5}}};
    const auto lane = [](int way) {
        Decisions decisions;
        decisions.add(way == 0), decisions.add(way == 1);
        return decisions;
    };
    EXPECT_EQ(replayed(flow, {lane(0), lane(1), lane(2), lane(2)}, 4).waves,
              (std::vector<uint64_t>{1, 1, 1, 1, 2}));  // nothing brings them together before the end
    EXPECT_EQ(replayed(flow, {lane(2), lane(2)}, 4).waves, (std::vector<uint64_t>{1, 0, 0, 1, 1}));
    EXPECT_EQ(replayed(flow, {lane(1)}, 4).waves, (std::vector<uint64_t>{1, 0, 1, 0, 0}));
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
