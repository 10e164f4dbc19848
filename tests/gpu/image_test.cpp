#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/device_impl.h"
#include "core/gpu/passes/pass_list.h"

#include <gtest/gtest.h>
#include <cstring>

namespace {

struct Images : testing::Test {
    Device device;
    PassList pass_list{device, {24, 16}};
    ParameterSet no_parameters;

    void SetUp() override { pass_list.begin_frame({}, no_parameters, {}); }
    void TearDown() override { EXPECT_EQ(device.validation_messages(), std::vector<std::string>()); }

    glm::vec4 stored(Format format, glm::vec4 value) {
        const Image target = pass_list.image("target", format);
        pass_list.compute("store_value.comp").write(target).set("value", value).run();
        const HostImage pixels = pass_list.download(target);
        glm::vec4 result(0);
        for (unsigned c = 0; c < pixels.channels; ++c) result[int(c)] = pixels.pixel(23, 15)[c];
        return result;
    }
};

}  // namespace

TEST_F(Images, ClearsToExactTexels) {
    const auto cleared = [&](Format format, glm::vec4 value) {
        const Image image = pass_list.image("cleared", format, 2);
        pass_list.clear(image, value);
        const HostImage first = pass_list.download(image), last = pass_list.download(image.mip(1));
        EXPECT_EQ(first.values.back(), last.values.back());
        return first.values.front();
    };
    EXPECT_EQ(cleared(Format::r32ui, glm::vec4(16777215.0f)), 16777215.0f);
    EXPECT_EQ(cleared(Format::r32f, glm::vec4(0.1f)), 0.1f);
    EXPECT_EQ(cleared(Format::r16f, glm::vec4(-2.5f)), -2.5f);
    EXPECT_EQ(cleared(Format::rg8, glm::vec4(1.0f)), 1.0f);
    EXPECT_EQ(cleared(Format::r11g11b10f, glm::vec4(0.5f)), 0.5f);
    const Image depth = pass_list.image("depth_buffer", Format::d32f);
    pass_list.clear(depth, glm::vec4(0.25f));
    EXPECT_EQ(pass_list.download(depth).values.back(), 0.25f);
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
    const Image image = pass_list.image("uploaded", Format::r16f);
    pass_list.upload(image, host);
    EXPECT_EQ(pass_list.download(image).values.front(), above);
}

TEST_F(Images, CountsAtomically) {
    const Image counters = pass_list.image_of("counters", Format::r32ui, {3, 2});
    pass_list.clear(counters, glm::vec4(5.0f));
    pass_list.compute("count_pixels.comp").write(counters).run(glm::uvec2(24, 16));
    EXPECT_EQ(pass_list.download(counters).values, std::vector<float>(6, 69.0f));
}

TEST_F(Images, FiltersOnlyWhenAsked) {
    const Image source = pass_list.image_of("source", Format::r32f, {2, 2}),
                target = pass_list.image_of("target", Format::r32f, {1, 1});
    HostImage corners({2, 2}, 1);
    corners.values = {0, 1, 2, 5};
    pass_list.upload(source, corners);
    pass_list.compute("sample_linear.comp").read_linear(source).write(target).run();
    EXPECT_NEAR(pass_list.download(target).values[0], 2.0f,
                0.02f);  // filters have 8 fractional bits (Vulkan 1.3, table 53)
    pass_list.compute("sample_linear.comp").read(source).write(target).run();
    const float nearest = pass_list.download(target).values[0];
    EXPECT_TRUE(nearest == 0 || nearest == 1 || nearest == 2 || nearest == 5);
}

TEST_F(Images, RoundTripBuffers) {
    const Buffer buffer = pass_list.buffer("bytes", 4096);
    std::vector<uint32_t> values(1024);
    for (size_t i = 0; i < values.size(); ++i) values[i] = uint32_t(i * 2654435761u);
    EXPECT_EQ(pass_list.download(buffer), std::vector<std::byte>(4096));  // zeros at first
    pass_list.upload(buffer, std::as_bytes(std::span(values)));
    std::vector<uint32_t> read(1024);
    std::memcpy(read.data(), pass_list.download(buffer).data(), 4096);
    EXPECT_EQ(read, values);
    EXPECT_THROW(pass_list.buffer("odd", 3), Error);
    EXPECT_THROW(pass_list.upload(buffer, std::vector<std::byte>(5000)), Error);
}

TEST_F(Images, OutliveAGraphThatHasOnlyRecordedThem) {
    Image result;
    {
        PassList recording(device, {24, 16}, Clock::gpu_timestamp);
        recording.begin_frame({}, no_parameters, {});
        result = recording.image("target", Format::r32f);
        recording.compute("store_value.comp").write(result).set("value", glm::vec4(3.0f)).run();
    }
    EXPECT_EQ(pass_list.download(result).values.front(), 3.0f);
}

TEST_F(Images, MayBeReplacedWhileRecorded) {
    PassList recording(device, {24, 16}, Clock::gpu_timestamp);
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
        PassList passes(device, {24, 16}, clock);
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
