// Shaders of known counts: what the model says of them is what arithmetic says.
#include "experiments/gpu_costs/chips/shader_work.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_list.h"
#include "experiments/gpu_costs/chips/chip_time.h"
#include "experiments/gpu_costs/waves/pass_tracer.h"
#include "tests/gpu_costs/known_chip.h"

#include <gtest/gtest.h>

namespace {

struct ShaderWorkTest : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    void SetUp() override {
        try {
            known_chip("navi21");
        } catch (const MachineError& e) {
            GTEST_SKIP() << e.what();
        }
    }

    ParameterSet no_parameters;
    CameraData camera{};

    /// Of repeated_lines.comp over one workgroup, so one wave of 64 lanes.
    ChipWork work(const std::string& chip, const std::string& lines, int turns, int per_lane = 0) {
        PassList pass_list(device(), {64, 1});
        std::optional<PassTrace> trace;
        std::vector<std::byte> content;
        PassTracer tracer([&](const PassTrace& t) {
            trace = t;
            content.assign(t.content.begin(), t.content.end());
        });
        pass_list.watch(&tracer);
        pass_list.begin_frame(camera, no_parameters, {});
        const Image source = pass_list.image_of("source", Format::rgba32f, {64, 64});
        pass_list.clear(source, glm::vec4(0.5f));
        pass_list.compute("repeated_lines.comp")
            .read(source)
            .write(pass_list.image("target", Format::rgba32f))
            .set("turns", turns)
            .set("per_lane", per_lane)
            .include("lines", lines)
            .run();
        const ShaderFlow flow = flow_of(trace->recipe);
        const MarkedShader marks = marked(trace->recipe, flow);
        const std::vector<CompiledPipeline> compiled =
            compile_for_chip(known_chip(chip), {trace->recipe, marks.recipe}, {.cache = {}, .has_assembly = true});
        for (const CompiledPipeline& pipeline : compiled) EXPECT_EQ(pipeline.refusal, "");
        // The compiler's sums of clocks guess how often loops run, and count for nothing.
        CompiledShader original = compiled[0].shaders.back();
        original.inverse_throughput = *original.inverse_throughput / 4, original.latency = *original.latency / 4;
        const ShaderWork of_blocks = shader_work(marks, original, compiled[0].shaders.back(),
                                                 compiled[1].shaders.back(), chip, *chip_rates(chip));
        EXPECT_EQ(of_blocks.lanes, 64u);
        const WaveCounts counts = replay(flow, lanes_of(trace->layout, content, 0), of_blocks.lanes);
        ChipWork sum;
        for (size_t b = 0; b < counts.waves.size(); ++b) sum.add(of_blocks.blocks[b].work, double(counts.waves[b]));
        return sum;
    }
};

std::string repeated(const std::string& line, int times) {
    std::string lines;
    for (int i = 0; i < times; ++i) lines += line + "\n";
    return lines;
}

constexpr std::array chips = {"navi21", "gfx1100", "vega10"};

/// Clocks of a SIMD for an instruction of a wave of 64: lanes of RDNA's SIMDs are 32, of GCN's 16.
double clocks(const std::string& chip) { return chip == "vega10" ? 4 : 2; }

}  // namespace

/// 40 more products with a sum in each of 7 turns.
TEST_F(ShaderWorkTest, ArithmeticTakesItsClocksInEachTurn) {
    const std::string line = "x.x = x.x * y + 0.3;";
    for (const std::string chip : chips) {
        const double few = work(chip, repeated(line, 20), 7).vector, many = work(chip, repeated(line, 60), 7).vector;
        EXPECT_EQ(many - few, 40 * 7 * clocks(chip)) << chip;
    }
}

/// Roots run at a quarter of the rate.
TEST_F(ShaderWorkTest, SlowFunctionsTakeFourTimesAsLong) {
    for (const std::string chip : chips) {
        const double few = work(chip, repeated("x.x = inversesqrt(x.x);", 10), 5).vector,
                     many = work(chip, repeated("x.x = inversesqrt(x.x);", 30), 5).vector;
        EXPECT_EQ(many - few, 20 * 5 * 4 * clocks(chip)) << chip;
    }
}

/// Lane n takes n + 3 turns: the wave takes 66, whatever part of it still runs.
TEST_F(ShaderWorkTest, DivergentLoopsTakeAsLongAsTheLongestLane) {
    const std::string line = "x.x = x.x * y + 0.3;";
    for (const std::string chip : chips) {
        const double few = work(chip, repeated(line, 20), 3, 1).vector,
                     many = work(chip, repeated(line, 60), 3, 1).vector;
        EXPECT_EQ(many - few, 40 * 66 * clocks(chip)) << chip;
    }
}

/// Loads of one texel each, and samples.
TEST_F(ShaderWorkTest, FetchesAreCountedByLanes) {
    for (const std::string chip : chips) {
        const std::string load = "x += texelFetch(source, ivec2(lane, int(x.y)), 0);",
                          sample_ = "x += textureLod(source, x.xy, 0.0);";
        EXPECT_EQ(work(chip, repeated(load, 9), 5).loads - work(chip, repeated(load, 4), 5).loads, 5 * 5 * 64) << chip;
        EXPECT_EQ(work(chip, repeated(sample_, 9), 5).samples - work(chip, repeated(sample_, 4), 5).samples, 5 * 5 * 64)
            << chip;
    }
}

/// Each of 6 loads needs what the one before found, in each of 5 turns: a wave that is alone waits for all of them.
TEST_F(ShaderWorkTest, DependentFetchesWaitForEachOther) {
    const std::string load = "x.x += texelFetch(source, ivec2(x.x), 0).x;";
    for (const std::string chip : chips) {
        const double one = work(chip, repeated(load, 1), 5).latency, six = work(chip, repeated(load, 6), 5).latency;
        EXPECT_NEAR((six - one) / (5 * 5), chip_rates(chip)->memory_latency, 20)
            << chip << ": and what calculates the place";
    }
}

/// A stream: 100 MB are read once and written once. The cache of navi21 gives 128 MB of them at 2000 GB/s, its memory
/// the rest at 512. A clock at 2.25 GHz loads 32 texels of 4 bytes in each of 72 units, which do not hold it up.
TEST(ChipTime, AStreamTakesWhatMemoryTakes) {
    const ChipRates rates = *chip_rates("navi21");
    const double texels = 25e6, waves = texels / 64;
    StageWork stage;
    stage.work.loads = texels, stage.work.stores = texels, stage.waves = waves;
    stage.work.vector = waves * 20, stage.work.latency = waves * 400;
    stage.resident_latency = stage.work.latency / 16, stage.wave_latency = 400;
    const PassCost cost{
        .texels = uint64_t(texels), .bytes_read = 100000000, .bytes_written = 100000000, .unique_bytes = 200000000};
    const ChipTime time = chip_time(stage, cost, rates);
    EXPECT_DOUBLE_EQ(time.memory, (128e6 / 2000e9 + 72e6 / 512e9) * 1e6);
    EXPECT_STREQ(bound_of(time).name, "memory");
    EXPECT_DOUBLE_EQ(time.textures, texels * (1.0 / 32 + 1.0 / 16) / 72 / 2250);
    EXPECT_DOUBLE_EQ(time.vector, waves * 20 / 144 / 2250);
    EXPECT_DOUBLE_EQ(time.latency, waves * 400 / 16 / 144 / 2250);
    const ChipTime without_cache = chip_time(stage, cost, *chip_rates("vega10"));
    EXPECT_DOUBLE_EQ(without_cache.memory, 200e6 / 483.8e9 * 1e6);
}

/// One wave takes its time however many units there are.
TEST(ChipTime, AFewWavesTakeAsLongAsOne) {
    StageWork stage;
    stage.work.latency = 4500, stage.resident_latency = 4500.0 / 16, stage.wave_latency = 4500;
    EXPECT_DOUBLE_EQ(chip_time(stage, {}, *chip_rates("navi21")).latency, 2);
}

TEST(ChipRates, ThoseOfOthersAreNotKnown) { EXPECT_FALSE(chip_rates("navi10")); }
