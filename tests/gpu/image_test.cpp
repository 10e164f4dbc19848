#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/device_impl.h"
#include "core/gpu/passes/pass_graph.h"

#include <gtest/gtest.h>
#include <cstring>

namespace {

struct Images : testing::Test {
    Device device;
    PassGraph graph{device, {24, 16}};
    ParameterSet no_parameters;

    void SetUp() override { graph.begin_frame({}, no_parameters, {}); }
    void TearDown() override { EXPECT_EQ(device.validation_messages(), std::vector<std::string>()); }

    glm::vec4 stored(Format format, glm::vec4 value) {
        const Image target = graph.image("target", format);
        graph.compute("store_value.comp").write(target).set("value", value).run();
        const HostImage pixels = graph.download(target);
        glm::vec4 result(0);
        for (unsigned c = 0; c < pixels.channels; ++c) result[int(c)] = pixels.pixel(23, 15)[c];
        return result;
    }
};

}  // namespace

TEST_F(Images, ClearsToExactTexels) {
    const auto cleared = [&](Format format, glm::vec4 value) {
        const Image image = graph.image("cleared", format, 2);
        graph.clear(image, value);
        const HostImage first = graph.download(image), last = graph.download(image.mip(1));
        EXPECT_EQ(first.values.back(), last.values.back());
        return first.values.front();
    };
    EXPECT_EQ(cleared(Format::r32ui, glm::vec4(16777215.0f)), 16777215.0f);
    EXPECT_EQ(cleared(Format::r32f, glm::vec4(0.1f)), 0.1f);
    EXPECT_EQ(cleared(Format::r16f, glm::vec4(-2.5f)), -2.5f);
    EXPECT_EQ(cleared(Format::rg8, glm::vec4(1.0f)), 1.0f);
    EXPECT_EQ(cleared(Format::r11g11b10f, glm::vec4(0.5f)), 0.5f);
    const Image depth = graph.image("depth_buffer", Format::d32f);
    graph.clear(depth, glm::vec4(0.25f));
    EXPECT_EQ(graph.download(depth).values.back(), 0.25f);
}

TEST_F(Images, StoresFromComputeInEveryColorFormat) {
    const glm::vec4 value(0.25f, 0.5f, 1.0f, 0.75f);  // exact in floats of 6 bits and more
    for (const Format format : {Format::r16f, Format::rg16f, Format::rgba16f, Format::r32f, Format::rg32f,
                                Format::rgba32f, Format::r11g11b10f}) {
        const glm::vec4 result = stored(format, value);
        for (int c = 0; c < 4; ++c)
            EXPECT_TRUE(result[c] == value[c] || result[c] == 0.0f) << int(format);  // 0: no such channel
        EXPECT_EQ(result.x, value.x);
    }
    for (const Format format : {Format::r8, Format::rg8, Format::rgba8})
        EXPECT_NEAR(stored(format, value).x, 0.25f, 0.5f / 255.0f + 1e-6f);
}

TEST_F(Images, StoresHalvesWithinOneStep) {
    // Vulkan lets a device round either way. Which way is worth knowing: where halves are truncated, histories drift
    // dark.
    const float value = 1.0f + 0.75f / 1024.0f, below = 1.0f, above = 1.0f + 1.0f / 1024.0f;
    const float result = stored(Format::r16f, glm::vec4(value)).x;
    EXPECT_TRUE(result == below || result == above) << result;
    RecordProperty("half_store", result == below ? "truncates" : "rounds");
    HostImage host({24, 16}, 1, value);  // the way up rounds to the nearest on every device
    const Image image = graph.image("uploaded", Format::r16f);
    graph.upload(image, host);
    EXPECT_EQ(graph.download(image).values.front(), above);
}

TEST_F(Images, CountsAtomically) {
    const Image counters = graph.image_of("counters", Format::r32ui, {3, 2});
    graph.clear(counters, glm::vec4(5.0f));
    graph.compute("count_pixels.comp").write(counters).run(glm::uvec2(24, 16));
    EXPECT_EQ(graph.download(counters).values, std::vector<float>(6, 69.0f));
}

TEST_F(Images, FiltersOnlyWhenAsked) {
    const Image source = graph.image_of("source", Format::r32f, {2, 2}),
                target = graph.image_of("target", Format::r32f, {1, 1});
    HostImage corners({2, 2}, 1);
    corners.values = {0, 1, 2, 5};
    graph.upload(source, corners);
    graph.compute("sample_linear.comp").read_linear(source).write(target).run();
    EXPECT_NEAR(graph.download(target).values[0], 2.0f,
                0.02f);  // filters have 8 fractional bits (Vulkan 1.3, table 53)
    graph.compute("sample_linear.comp").read(source).write(target).run();
    const float nearest = graph.download(target).values[0];
    EXPECT_TRUE(nearest == 0 || nearest == 1 || nearest == 2 || nearest == 5);
}

TEST_F(Images, RoundTripBuffers) {
    const Buffer buffer = graph.buffer("bytes", 4096);
    std::vector<uint32_t> values(1024);
    for (size_t i = 0; i < values.size(); ++i) values[i] = uint32_t(i * 2654435761u);
    EXPECT_EQ(graph.download(buffer), std::vector<std::byte>(4096));  // zeros at first
    graph.upload(buffer, std::as_bytes(std::span(values)));
    std::vector<uint32_t> read(1024);
    std::memcpy(read.data(), graph.download(buffer).data(), 4096);
    EXPECT_EQ(read, values);
    EXPECT_THROW(graph.buffer("odd", 3), Error);
    EXPECT_THROW(graph.upload(buffer, std::vector<std::byte>(5000)), Error);
}

TEST_F(Images, OutliveAGraphThatHasOnlyRecordedThem) {
    Image result;
    {
        PassGraph recording(device, {24, 16}, Clock::gpu_timestamp);
        recording.begin_frame({}, no_parameters, {});
        result = recording.image("target", Format::r32f);
        recording.compute("store_value.comp").write(result).set("value", glm::vec4(3.0f)).run();
    }
    EXPECT_EQ(graph.download(result).values.front(), 3.0f);
}

TEST_F(Images, MayBeReplacedWhileRecorded) {
    PassGraph recording(device, {24, 16}, Clock::gpu_timestamp);
    recording.begin_frame({}, no_parameters, {});
    recording.compute("store_value.comp")
        .write(recording.image("target", Format::r32f))
        .set("value", glm::vec4(1.0f))
        .run();
    const Image other = recording.image("target", Format::rgba32f);  // drops the first
    recording.compute("store_value.comp").write(other).set("value", glm::vec4(2.0f)).run();
    EXPECT_EQ(recording.download(other).values.front(), 2.0f);
    EXPECT_EQ(recording.times().size(), 1u);
    EXPECT_GE(recording.frame_milliseconds(), recording.times()[0].milliseconds * 0.5);
}

/// On either clock: with time stamps of the device, passes of the image that is replaced may only be recorded.
TEST_F(Images, AllowNoMoreThanTheirPassesAskFor) {
    using Use = vk::ImageUsageFlagBits;
    const vk::ImageUsageFlags always = Use::eTransferSrc | Use::eTransferDst | Use::eSampled;
    for (const Clock clock : {Clock::host_fence, Clock::gpu_timestamp}) {
        PassGraph passes(device, {24, 16}, clock);
        passes.begin_frame({}, no_parameters, {});
        const auto uses = [](const Image& image) { return image.storage->info.usage; };
        const Image both = passes.image("both", Format::r32f, 2), drawn = passes.image("drawn", Format::r32f),
                    copied = passes.image("copied", Format::r32f);
        passes.clear(copied, glm::vec4(0));
        passes.fragment("constant_color.frag").set("value", glm::vec4(4)).write(drawn.as("color")).run();
        passes.compute("store_value.comp").set("value", glm::vec4(5)).write(both.mip(0).as("target")).run({24, 16});
        EXPECT_EQ(uses(copied), always);
        EXPECT_EQ(uses(drawn), always | Use::eColorAttachment);
        EXPECT_EQ(uses(both), always | Use::eStorage);
        passes.fragment("constant_color.frag").set("value", glm::vec4(6)).write(both.mip(1).as("color")).run();
        EXPECT_EQ(uses(both), always | Use::eStorage | Use::eColorAttachment);
        EXPECT_EQ(passes.download(both.mip(0)).values.back(), 5) << "what it held before it was drawn to";
        EXPECT_EQ(passes.download(both.mip(1)).values.back(), 6);
    }
}
