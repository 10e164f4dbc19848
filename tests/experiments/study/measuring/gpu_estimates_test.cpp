#include "experiments/study/measuring/costs/gpu_estimates.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/gpu_costs/waves/pass_tracer.h"
#include "experiments/gpu_costs/waves/traced_shader.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/measuring/costs/costs.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/needs.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <random>

namespace {

struct GpuEstimates : testing::Test {
    /// Of the coverage 512 groups of 8 x 8, which are all traced; more where some are not to be traced; few of the
    /// others, whose shaders take most of the time.
    static glm::uvec2 extent() {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        if (name == "TracingChangesNoBit") return {264, 136};
        return name.starts_with("Cover") ? glm::uvec2(256, 128) : glm::uvec2(48, 32);
    }
    static Device& device() {
        static Device shared;
        return shared;
    }
    const Shot shot =
        load_shot({.scene = "mirror_pillars", .extent = extent(), .frames = {0}, .warm_up = 1, .direct_lit = true},
                  scene_search_path({}));
    const HostImage unused;
    const std::function<const HostImage&(const FrameStep&)> lit = [this](const FrameStep&) -> const HostImage& {
        return unused;
    };
    std::unique_ptr<FrameSource> source;
    std::unique_ptr<FrameStore> store;

    TracedFrame trace(const PointConfig& point) {
        open(point);
        return trace_last_frame(device(), shot, *store, lit, point, true, [](double) {});
    }
    void open(const PointConfig& point) {
        source = scene_source(device(), shot, timed_config({point}, 0), true);
        store = std::make_unique<FrameStore>(*source, shot.config, 0);
    }
    /// What the technique shows in the last frame.
    std::vector<float> radiance(const PointConfig& point, bool is_traced) {
        open(point);
        const Renderer renderer(device(), shot.config.extent, point);
        renderer.pass_list->use_gpu_forms(true);
        PassTracer tracer([](const PassTrace&) {});
        if (is_traced) renderer.pass_list->watch(&tracer);
        std::vector<float> values;
        for (const FrameStep& step : shot.steps) {
            const FrameStore::Frame frame = store->frame(step, lit(step));
            const Reflections result = renderer.render(frame.camera, 1, frame.gbuffer);
            values = renderer.pass_list->download(result.radiance).values;
        }
        return values;
    }
};

}  // namespace

/// Passes that write down their ways compute what they compute without.
TEST_F(GpuEstimates, TracingChangesNoBit) {
    for (const std::string technique : {"mcguire_dda", "diligent_ssr"}) {
        const PointConfig point = single_point(technique);
        EXPECT_EQ(radiance(point, true), radiance(point, false)) << technique;
    }
}

/// What is counted in the forms for GPUs stands for all devices, and pipelines come with the trace.
TEST_F(GpuEstimates, ATracedFrameBringsTheCountsAndPipelinesOfItsPoint) {
    const auto described = [](const StagePipelines& pipelines) {
        std::vector<std::string> all;
        for (const StagePipelines::Entry& entry : pipelines.entries())
            all.push_back(entry.stage + ' ' + std::to_string(entry.number) + bytes_of({entry.recipe}));
        return all;
    };
    for (const std::string technique : {"mcguire_dda", "amd_sssr"}) {
        const PointConfig point = single_point(technique);
        const TracedFrame frame = trace(point);
        open(point);
        EXPECT_EQ(described(frame.pipelines), described(stage_pipelines(device(), shot, *store, lit, point, true)));
        EXPECT_EQ(frame.is_of_gpu_forms, technique == "amd_sssr");
        if (frame.is_of_gpu_forms) continue;
        open(point);
        const std::vector<CostRow> counted = count_costs(device(), shot, *store, lit, point, true, [](double) {}),
                                   traced = cost_rows(frame.costs, shot.name(), point);
        ASSERT_EQ(counted.size(), traced.size());
        for (size_t i = 0; i < counted.size(); ++i)
            EXPECT_EQ(counted[i].stage + counted[i].quantity + std::to_string(counted[i].value),
                      traced[i].stage + traced[i].quantity + std::to_string(traced[i].value));
    }
}

/// Two ways to count invocations and what they fetch agree: the counters of the shaders, and the lanes that left a
/// record.
void expect_all_counts(const TracedFrame& frame) {
    std::map<std::string, uint64_t> lanes, fetches;
    for (const TracedFrame::Pass& pass : frame.passes)
        for (const WaveCounts& group : pass.traced.at(64)) {
            lanes[pass.stage] += group.lanes.at(0);
            for (size_t b = 0; b < group.lanes.size(); ++b)
                fetches[pass.stage] += group.lanes[b] * pass.flow.blocks[b].fetches;
            EXPECT_EQ(group.cut, 0u) << pass.stage;
        }
    for (const PassCost& cost : frame.costs) {
        if (cost.stage == "clear") continue;
        EXPECT_EQ(lanes[cost.stage], cost.invocations) << cost.stage;
        EXPECT_EQ(fetches[cost.stage], cost.fetches) << cost.stage;
    }
}

TEST_F(GpuEstimates, EveryStageHasAnEstimateWithItsInterval) {
    const GpuCompilers compilers = find_compilers({"navi21", "navi10"});
    if (const std::string& why = compilers.entries.front().refusal; !why.empty()) GTEST_SKIP() << why;
    const std::filesystem::path cache = std::filesystem::temp_directory_path() / "gpu_estimates_cache";
    std::filesystem::remove_all(cache);
    for (const std::string technique : {"amd_sssr", "diligent_ssr"}) {
        const PointConfig point = single_point(technique);
        const TracedFrame frame = trace(point);
        expect_all_counts(frame);
        const std::vector<EstimateRow> rows = estimate_rows(frame, shot.name(), point, compilers, {.cache = cache});
        ASSERT_GT(rows.size(), 5u) << technique;
        double sum = 0;
        for (const EstimateRow& row : rows) {
            if (row.chip == "navi10") {
                EXPECT_EQ(row.refusal, "ssrlab has no published rates of navi10");
                continue;
            }
            const std::string where = technique + ' ' + row.stage;
            ASSERT_EQ(row.refusal, "") << where;
            EXPECT_GT(row.microseconds, 0) << where;
            EXPECT_LE(row.low, row.microseconds) << where;
            EXPECT_GE(row.high, row.microseconds) << where;
            EXPECT_LT(row.unmatched, 0.3) << where;
            if (row.stage != "clear") {
                EXPECT_GT(row.active_lanes, 0) << where;
                EXPECT_LE(row.active_lanes, 1) << where;
                EXPECT_GE(row.waves, 1) << where;
            }
            if (row.stage == "total")
                EXPECT_NEAR(*row.microseconds, sum, 1e-9 * sum) << technique;
            else
                sum += *row.microseconds;
        }
    }
    std::filesystem::remove_all(cache);
}

namespace {

/// Estimates of the march of a real frame, whose groups differ by two orders of magnitude, for a chip of 144 SIMDs.
struct EstimatesOfSamples : GpuEstimates {
    const GpuCompilers compilers = find_compilers({"polaris10"});
    const std::filesystem::path cache = std::filesystem::temp_directory_path() / "gpu_estimates_coverage";
    const PointConfig point = single_point("mcguire_dda");

    TracedFrame traced_march() {
        TracedFrame frame = trace(point);
        const auto is_other = [](const auto& of_stage) { return of_stage.stage != "mcguire_dda/trace"; };
        std::erase_if(frame.passes, is_other);
        std::erase_if(frame.costs, is_other);
        return frame;
    }

    EstimateRow march(const TracedFrame& frame) const {
        return estimate_rows(frame, shot.name(), point, compilers, {.cache = cache}).front();
    }

    static TracedFrame with_groups_of(TracedFrame frame, size_t count, std::mt19937& random) {
        for (TracedFrame::Pass& pass : frame.passes) {
            std::vector<size_t> places(pass.traced.at(64).size());
            std::iota(places.begin(), places.end(), size_t(0));
            std::ranges::shuffle(places, random);
            for (auto& [width, groups] : pass.traced) {
                std::vector<WaveCounts> some;
                for (size_t i = 0; i < count; ++i) some.push_back(groups[places[i]]);
                groups = std::move(some);
            }
        }
        return frame;
    }

    /// The interval covers the truth in as many samples of `count` groups as it states. Of 100 intervals that cover
    /// 95 %, fewer than 88 cover with a probability of 0.002.
    void expect_coverage(const TracedFrame& all, const EstimateRow& truth, size_t count) {
        std::mt19937 random(1);
        unsigned covers = 0;
        double widths = 0;
        for (int repetition = 0; repetition < 100; ++repetition) {
            const EstimateRow row = march(with_groups_of(all, count, random));
            EXPECT_EQ(row.bound, truth.bound);
            const double half = *row.high - *row.microseconds;
            covers += std::abs(*row.microseconds - *truth.microseconds) <= half;
            widths += half / *truth.microseconds / 100;
        }
        EXPECT_GE(covers, 88u);
        EXPECT_GT(widths, 0.001);
        EXPECT_LT(widths, 0.3);
    }
};

}  // namespace

/// The frame stands for 32 of its kind, so that the chip is full and its vector units take longest.
TEST_F(EstimatesOfSamples, CoverTheSumsOfAllGroups) {
    if (const std::string& why = compilers.entries.front().refusal; !why.empty()) GTEST_SKIP() << why;
    std::filesystem::remove_all(cache);
    TracedFrame all = traced_march();
    for (TracedFrame::Pass& pass : all.passes) {
        ASSERT_EQ(pass.traced.at(64).size(), pass.groups) << "not all were traced";
        pass.groups *= 32;
        for (auto& [width, groups] : pass.traced) {
            const std::vector<WaveCounts> once = groups;
            for (int i = 1; i < 32; ++i) groups.insert(groups.end(), once.begin(), once.end());
        }
    }
    for (PassCost& cost : all.costs)
        for (const CostQuantity& quantity : cost_quantities) cost.*quantity.member *= 32;
    const EstimateRow truth = march(all);
    ASSERT_EQ(truth.bound, "vector");
    EXPECT_EQ(truth.high, truth.microseconds) << "nothing was sampled";
    expect_coverage(all, truth, 128);
    std::filesystem::remove_all(cache);
}

/// The frame is as small as 128 of its groups, of which each has a SIMD for itself, so that it waits for one wave: the
/// longest if all were traced, else the mean one. With one group that was not traced that is the mean of the others.
TEST_F(EstimatesOfSamples, CoverTheMeanWave) {
    if (const std::string& why = compilers.entries.front().refusal; !why.empty()) GTEST_SKIP() << why;
    std::filesystem::remove_all(cache);
    std::mt19937 random(2);
    TracedFrame few = with_groups_of(traced_march(), 128, random);
    for (PassCost& cost : few.costs) cost.unique_bytes = 0;  // the whole frame's
    for (TracedFrame::Pass& pass : few.passes) pass.groups = 128;
    const EstimateRow longest = march(few);
    for (TracedFrame::Pass& pass : few.passes) pass.groups = 129;
    const EstimateRow mean = march(few);
    ASSERT_EQ(longest.bound, "latency");
    EXPECT_EQ(longest.high, longest.microseconds) << "nothing was sampled";
    EXPECT_LT(*mean.microseconds, 0.9 * *longest.microseconds);
    expect_coverage(few, mean, 64);
    std::filesystem::remove_all(cache);
}
