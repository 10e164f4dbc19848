#include "experiments/gpu_costs/pass_cost.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_list.h"

#include <gtest/gtest.h>

namespace {

struct PassCosts : testing::TestWithParam<Clock> {
    static Device& device() {
        static Device shared;
        return shared;
    }
    ParameterSet no_parameters;
    CameraData camera{};
    PassList pass_list{device(), {10, 9}, GetParam()};
    CostCounter counter;

    void SetUp() override { begin(); }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }
    void begin() { pass_list.begin_frame(camera, no_parameters, {}); }

    Image cleared(const std::string& name, Format format, unsigned mips = 1) {
        const Image image = pass_list.image(name, format, mips);
        pass_list.clear(image, glm::vec4(1.0f));
        return image;
    }
    HostImage run_counted_shader() {
        const Image source = cleared("source", Format::rgba16f), filtered = cleared("filtered", Format::r32f),
                    mipped = cleared("mipped", Format::rgba8, 3), target = pass_list.image("target", Format::rgba32f);
        begin();
        pass_list.compute("counted.comp")
            .read(source)
            .read_linear(filtered)
            .read_linear(mipped)
            .write(target)
            .use(pass_list.buffer("entries", 64))
            .use(pass_list.buffer("sums", 4))
            .run();
        return pass_list.download(target);
    }
    PassCost only_cost() {
        EXPECT_EQ(counter.costs().size(), 1u);
        return counter.costs().at(0);
    }
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Clocks, PassCosts, testing::Values(Clock::host_fence, Clock::gpu_timestamp),
                         [](const auto& info) {
                             return info.param == Clock::host_fence ? "HostFence" : "GpuTimestamp";
                         });

/// By hand, for 10 x 9 pixels in 2 x 2 groups of 64: loops of 0 to 9 fetches, one fetch, one filtered sample and one
/// gather each, and a sample between mips in all rows but the first.
TEST_P(PassCosts, AreThoseOfTheShaderByHand) {
    const HostImage uncounted = run_counted_shader();
    EXPECT_TRUE(counter.costs().empty());
    pass_list.watch(&counter);
    const HostImage counted = run_counted_shader();
    EXPECT_EQ(counted.values, uncounted.values);

    const PassCost cost = only_cost();
    const uint64_t pixels = 90, loops = 9 * 45, between_mips = 80;
    EXPECT_EQ(cost.stage, "counted");
    EXPECT_EQ(cost.invocations, 256u);
    EXPECT_EQ(cost.idle, 256 - pixels);
    EXPECT_EQ(cost.fetches, loops + 3 * pixels + between_mips);
    EXPECT_EQ(cost.texels, loops + (1 + 4 + 4) * pixels + 8 * between_mips);
    const uint64_t read = loops * 8 + 9 * pixels * 4 + 8 * between_mips * 4, entries = pixels * 20;
    EXPECT_EQ(cost.bytes_read, read + entries + 4);  // and the atomic sum
    EXPECT_EQ(cost.bytes_written, pixels * 16 + 4 + 4);
    EXPECT_EQ(cost.shared_bytes, 16u);
    EXPECT_EQ(cost.atomics, 1u);
    // All of the images, whose 3 mips have 10 x 9, 5 x 4 and 2 x 2 texels; of the buffers the first no more than it
    // has.
    EXPECT_EQ(cost.unique_bytes, pixels * 8 + pixels * 4 + (90 + 20 + 4) * 4 + 64 + 4 + pixels * 16 + 4 + 4);
    run_counted_shader();
    for (const CostQuantity& quantity : cost_quantities)
        EXPECT_EQ(only_cost().*quantity.member, cost.*quantity.member) << quantity.name;
}

TEST_P(PassCosts, OperationsAreThoseThatTheShaderStates) {
    pass_list.watch(&counter);
    const Image target = pass_list.image_of("target", Format::rgba32f, {8, 8});
    pass_list.compute("counted_operations.comp").write(target).run();
    // And conversions: 3 of the index to floats, 2 of the index to ints.
    EXPECT_EQ(only_cost().operations, 64u * (3 + 3 + 5 + 28 + 4 + 3 + 2 + 2));
}

/// 64 x 64 x 1100 KiB, more than 2^32 bytes.
TEST_P(PassCosts, AreNumbersOf64Bits) {
    pass_list.watch(&counter);
    pass_list.compute("counted_blocks.comp")
        .use(pass_list.buffer("blocks", 2048))
        .write(pass_list.image_of("target", Format::r32f, {64, 64}))
        .run();
    EXPECT_EQ(only_cost().bytes_read, uint64_t(64 * 64) * 1100 * 1024);
}

TEST_P(PassCosts, DiscardedFragmentsAreIdleAndRejectedOnesNone) {
    const Image source = cleared("source", Format::rgba8), color = cleared("color", Format::rgba16f),
                mask = pass_list.image("mask", Format::d32f_s8);
    pass_list.clear(mask, glm::vec4(0.0f));
    pass_list.watch(&counter);
    camera.extent = glm::vec4(pass_list.extent(), 0.1f, 0.1f);
    begin();
    pass_list.fragment("counted.frag").read(source).write(color).run();
    PassCost cost = only_cost();
    EXPECT_EQ(cost.invocations, 90u);
    EXPECT_EQ(cost.idle, 40u);
    EXPECT_EQ(cost.fetches, 90u + 50u);
    EXPECT_EQ(cost.bytes_written, 50u * 8);

    begin();
    pass_list.fragment("left_half.frag").stencil({Stencil::Mode::write, 1, mask}).label("halves").run();
    EXPECT_EQ(only_cost().idle, 45u);
    pass_list.fragment("constant_color.frag")
        .stencil({Stencil::Mode::keep_equal, 1, mask})
        .set("value", glm::vec4(5.0f))
        .write(color)
        .label("halves")
        .run();
    cost = only_cost();  // of the stage's two passes
    EXPECT_EQ(cost.invocations, 90u + 45u);
    EXPECT_EQ(cost.bytes_written, 45u * 8);

    pass_list.clear(color, glm::vec4(0.0f));
    EXPECT_EQ(counter.costs().back().stage, "clear");
    EXPECT_EQ(counter.costs().back().bytes_written, 90u * 8);
}
