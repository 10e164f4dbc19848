#include "core/gpu/device.h"
#include "core/gpu/passes/pass_list.h"
#include "experiments/gpu_costs/waves/pass_tracer.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <set>

namespace {

struct TracedShader : testing::TestWithParam<Clock> {
    static Device& device() {
        static Device shared;
        return shared;
    }
    ParameterSet no_parameters;
    CameraData camera{};
    std::vector<PassTrace> traces;
    std::deque<std::vector<std::byte>> contents;  ///< of the traces

    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }

    HostImage run(PassList& pass_list, bool is_traced) {
        pass_list.begin_frame(camera, no_parameters, {});
        PassTracer tracer([this](const PassTrace& trace) {
            contents.emplace_back(trace.content.begin(), trace.content.end());
            traces.emplace_back(trace).content = contents.back();
        });
        pass_list.watch(is_traced ? &tracer : nullptr);
        const Image source = pass_list.image_of("source", Format::rgba32f, {4, 4}),
                    target = pass_list.image("target", Format::rgba32f);
        pass_list.clear(source, glm::vec4(1, 2, 3, 4));
        pass_list.compute("wave_paths.comp").read(source).write(target).run();
        pass_list.watch(nullptr);
        return pass_list.download(target);
    }
};

/// What wave_paths.comp does in a pixel, written down again.
struct Path {
    std::vector<std::vector<int>> arms;  ///< which arm each turn of the inner loop takes, by the turns of the outer one
};
Path path_of(glm::ivec2 pixel) {
    Path path;
    float sum = 0;
    for (int round = 0; round < pixel.x % 5; ++round) {
        path.arms.emplace_back();
        for (int step = 0; step < (pixel.x + round) % 3; ++step) {
            const int arm = (pixel.x + step) & 1;
            path.arms.back().push_back(arm);
            sum += arm == 0 ? 1.0f : 2.0f;
            if (sum > (arm == 0 ? 3.5f : 5.5f)) return path;
        }
        if (round == pixel.y) break;
    }
    return path;
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Clocks, TracedShader, testing::Values(Clock::host_fence, Clock::gpu_timestamp),
                         [](const auto& info) {
                             return info.param == Clock::host_fence ? "HostFence" : "GpuTimestamp";
                         });

/// Turns of both loops by hand, in waves of 32 and 64 of workgroups of 8 x 8; 20 x 13 pixels have lanes beyond the
/// edge.
TEST_P(TracedShader, WavesTakeTheTurnsOfTheirBusiestLanes) {
    PassList pass_list(device(), {20, 13}, GetParam());
    const HostImage plain = run(pass_list, false);
    EXPECT_TRUE(traces.empty());
    const HostImage traced = run(pass_list, true);
    EXPECT_EQ(traced.values, plain.values);
    ASSERT_EQ(traces.size(), 1u);
    const PassTrace& trace = traces.front();
    EXPECT_EQ(trace.stage, "wave_paths");
    EXPECT_EQ(trace.layout.groups, 6u);
    EXPECT_EQ(trace.layout.chosen, 6u);

    const ShaderFlow flow = flow_of(trace.recipe);
    for (const unsigned width : {32u, 64u}) {
        uint64_t turns = 0, lane_turns = 0;
        for (int group = 0; group < 6; ++group)
            for (unsigned first = 0; first < 64; first += width) {
                std::vector<Path> paths;
                for (unsigned lane = first; lane < first + width; ++lane) {
                    const glm::ivec2 pixel(group % 3 * 8 + int(lane % 8), group / 3 * 8 + int(lane / 8));
                    if (pixel.x < 20 && pixel.y < 13) paths.push_back(path_of(pixel));
                }
                for (size_t round = 0; round < 4; ++round)
                    for (size_t step = 0; step < 2; ++step) {
                        std::set<int> arms;  // a wave runs each that one of its lanes takes
                        for (const Path& path : paths)
                            if (round < path.arms.size() && step < path.arms[round].size()) {
                                arms.insert(path.arms[round][step]);
                                ++lane_turns;
                            }
                        turns += arms.size();
                    }
            }
        // The arms in the inner loop are the only blocks that fetch and are in a loop.
        const std::vector<unsigned> depth = loop_depths(graph_of(flow));
        uint64_t found = 0, found_lanes = 0;
        for (unsigned place = 0; place < 6; ++place) {
            const WaveCounts counts = replay(flow, lanes_of(trace.layout, trace.content, place), width);
            EXPECT_EQ(counts.started, 64 / width);
            EXPECT_EQ(counts.lanes[0], 64u) << "those beyond the edge start, too";
            for (size_t b = 0; b < flow.blocks.size(); ++b)
                if (flow.blocks[b].has_memory && depth[b] > 0) found += counts.waves[b], found_lanes += counts.lanes[b];
        }
        EXPECT_EQ(found, turns) << width;
        EXPECT_EQ(found_lanes, lane_turns) << width;
    }
}

/// What all groups did is known here: it lies within five standard errors of what the chosen ones say.
TEST_P(TracedShader, ChosenGroupsStandForAll) {
    PassList pass_list(device(), {1024, 512}, GetParam());
    const HostImage plain = run(pass_list, false);
    EXPECT_EQ(run(pass_list, true).values, plain.values);
    const PassTrace& trace = traces.at(0);
    const ShaderFlow flow = flow_of(trace.recipe);
    const std::vector<unsigned> depth = loop_depths(graph_of(flow));
    ASSERT_EQ(trace.layout.groups, 128u * 64);
    ASSERT_LT(trace.layout.chosen, trace.layout.groups / 4);
    double sum = 0, squares = 0;
    for (unsigned place = 0; place < trace.layout.chosen; ++place) {
        const WaveCounts counts = replay(flow, lanes_of(trace.layout, trace.content, place), 64);
        EXPECT_EQ(counts.lanes[0], 64u) << "a group was chosen twice, or not all of it";
        double turns = 0;
        for (size_t b = 0; b < flow.blocks.size(); ++b)
            if (flow.blocks[b].has_memory && depth[b] > 0) turns += double(counts.lanes[b]);
        sum += turns, squares += turns * turns;
    }
    double all = 0;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x)
            for (const std::vector<int>& steps : path_of({x, y}).arms) all += double(steps.size());
    const double count = trace.layout.chosen, mean = sum / count, truth = all / trace.layout.groups,
                 error = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.02 * mean);
    EXPECT_NEAR(mean, truth, 5 * error);
}

/// Groups of 480 x 270 are those of 8 x 8 pixels of a frame of 3840x2160.
TEST(TraceLayout, EachGroupHasAPlaceOfItsOwnAndTheChosenAreSpread) {
    for (const glm::uvec3 groups : {glm::uvec3(1, 1, 1), glm::uvec3(240, 135, 1), glm::uvec3(480, 270, 1),
                                    glm::uvec3(7, 11, 13), glm::uvec3(4000, 1000, 1)}) {
        const TraceLayout layout = trace_layout(groups, 64, 512);
        std::vector<bool> is_taken(layout.chosen, false);
        std::array<unsigned, 8> in_part{};  // of eighths of all groups
        for (uint32_t group = 0; group < layout.groups; ++group) {
            const uint32_t place = group * layout.step % layout.groups;
            if (place >= layout.chosen) continue;
            EXPECT_FALSE(is_taken[place]);
            is_taken[place] = true;
            ++in_part[size_t(uint64_t(group) * 8 / layout.groups)];
        }
        EXPECT_TRUE(std::ranges::all_of(is_taken, std::identity()));
        if (layout.chosen < 512) continue;
        for (const unsigned count : in_part) EXPECT_NEAR(count, 64, 16) << layout.groups;
    }
}
