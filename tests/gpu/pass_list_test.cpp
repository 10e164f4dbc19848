#include "core/gpu/passes/pass_list.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/pipelines/shader.h"
#include "tests/declared_parameter.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <cstring>
#include <numeric>

namespace {

struct Graph : testing::Test {
    Device device;
    ParameterSet no_parameters;
    CameraData camera{};

    void TearDown() override { EXPECT_TRUE(device.validation_messages().empty()); }
    void begin(PassList& pass_list) {
        camera.extent = glm::vec4(pass_list.extent(), 1.0f / glm::vec2(pass_list.extent()));
        pass_list.begin_frame(camera, no_parameters, {});
    }
};

/// Both ways to time a frame must give the same images.
struct GraphOnBothClocks : Graph, testing::WithParamInterface<Clock> {
    PassList pass_list{device, {17, 13}, GetParam()};
    void SetUp() override { begin(pass_list); }
};

HostImage ramp(glm::uvec2 extent, unsigned channels, float scale) {
    HostImage image(extent, channels);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i) * scale;
    return image;
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Clocks, GraphOnBothClocks, testing::Values(Clock::host_fence, Clock::gpu_timestamp),
                         [](const auto& info) {
                             return info.param == Clock::host_fence ? "HostFence" : "GpuTimestamp";
                         });

TEST_P(GraphOnBothClocks, BindsSingleMipLevels) {
    const Image pyramid = pass_list.image_of("pyramid", Format::rgba32f, {16, 16}, 4);
    pass_list.clear(pyramid, {1, 0, 0, 0});
    for (unsigned level = 0; level < 3; ++level)
        pass_list.compute("halve.comp")
            .read(pyramid.mip(level).as("finer"))
            .write(pyramid.mip(level + 1).as("coarser"))
            .run();
    EXPECT_EQ(pass_list.download(pyramid.mip(3)).values.front(), 15.0f);  // 1 -> 3 -> 7 -> 15
    const auto times = pass_list.times();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].stage, "clear");
    EXPECT_EQ(times[1].stage, "halve");
}

TEST_P(GraphOnBothClocks, SwapsHistoryBetweenFrames) {
    for (int frame = 1; frame <= 3; ++frame) {
        begin(pass_list);
        const auto [sum, previous_sum] = pass_list.history("sum", Format::rgba32f);
        pass_list.compute("add_one.comp").read(previous_sum).write(sum).run();
        EXPECT_EQ(pass_list.download(sum).values.front(), float(frame));
    }
}

TEST_P(GraphOnBothClocks, CompactsWithSubgroupsAndDispatchesIndirectly) {
    const Image source = pass_list.image("source", Format::r32f), marks = pass_list.image("marks", Format::r8);
    HostImage values({17, 13}, 1);
    for (size_t i = 0; i < values.values.size(); ++i) values.values[i] = i % 7 == 0 ? 1.0f : 0.0f;
    pass_list.upload(source, values);
    const Buffer list = pass_list.buffer("pixel_list", 17 * 13 * 4), arguments = pass_list.buffer("arguments", 16),
                 invocations = pass_list.buffer("invocations", 4);
    pass_list.clear(arguments, 0);
    pass_list.clear(invocations, 0);
    pass_list.clear(marks, glm::vec4(0.0f));
    pass_list.compute("list_bright.comp")
        .read(source)
        .use(list)
        .use(arguments)
        .set("threshold", 0.5f)
        .run(source.extent);
    pass_list.compute("mark_listed.comp").use(list).use(arguments).use(invocations).write(marks).dispatch(arguments);
    EXPECT_EQ(pass_list.download(marks).values, values.values);
    uint32_t invocation_count = 0;
    std::memcpy(&invocation_count, pass_list.download(invocations).data(), 4);
    EXPECT_EQ(invocation_count, 64u);  // 32 pixels: one group, where all pixels would be four
}

/// Passes of one frame, which a GPU runs together at its end, with sets of their own.
TEST_P(GraphOnBothClocks, GivesPassesTheParametersThatAreSet) {
    const auto set_of = [](const std::vector<std::pair<const char*, float>>& values) {
        ParameterSet params;
        for (const auto& [name, value] : values) params.add(declared_number(name, "float", value, 0.0, 9.0));
        return params;
    };
    const ParameterSet first = set_of({{"scale", 1.0f}, {"offset", 2.0f}}),
                       second = set_of({{"scale", 3.0f}, {"offset", 4.0f}}),
                       other = set_of({{"offset", 5.0f}, {"scale", 6.0f}});  // the same names at other places
    pass_list.begin_frame(camera, first, {});
    const auto show = [&](const char* name) {
        const Image image = pass_list.image(name, Format::rgba32f);
        pass_list.compute("show_parameter.comp").write(image.as("shown")).run();
        return image;
    };
    const Image before = show("before");
    pass_list.set_params(second);
    const Image between = show("between");
    pass_list.set_params(other);
    const Image swapped = show("swapped");
    pass_list.set_params(first);
    const Image after = show("after");
    const auto values = [&](const Image& image) {
        const HostImage pixels = pass_list.download(image);
        return std::pair(pixels.values[0], pixels.values[1]);
    };
    EXPECT_EQ(values(before), std::pair(1.0f, 2.0f));
    EXPECT_EQ(values(between), std::pair(3.0f, 4.0f));
    EXPECT_EQ(values(swapped), std::pair(6.0f, 5.0f));
    EXPECT_EQ(values(after), std::pair(1.0f, 2.0f));
    EXPECT_EQ(&pass_list.params(), &first);

    const ParameterSet third = set_of({}), fourth = set_of({});
    pass_list.set_params(third);
    EXPECT_EQ(error_message([&] { pass_list.set_params(fourth); }), "more than 4 sets of parameters in one frame");
}

TEST_P(GraphOnBothClocks, StencilKeepsPassesToMarkedPixels) {
    const Image mask = pass_list.image("mask", Format::d32f_s8), color = pass_list.image("color", Format::rgba32f);
    pass_list.clear(mask, glm::vec4(0.0f));
    pass_list.clear(color, glm::vec4(0.0f));
    pass_list.fragment("left_half.frag").stencil({Stencil::Mode::write, 1, mask}).run();
    pass_list.fragment("constant_color.frag")
        .stencil({Stencil::Mode::keep_equal, 1, mask})
        .set("value", glm::vec4(5.0f))
        .write(color)
        .run();
    const HostImage result = pass_list.download(color);
    EXPECT_EQ(result.pixel(7, 6)[0], 5.0f);
    EXPECT_EQ(result.pixel(9, 6)[0], 0.0f);
}

TEST_P(GraphOnBothClocks, DrawsMeshesWithDepthTestCullingAndTextures) {
    // Two triangles that cover everything: instance 3 at depth 0.75, counter-clockwise, and instance 8 before it at
    // 0.25.
    const float clip[] = {-1, 3, 0.75f, 3, -1, 0.75f, -1, -1, 0.75f, -1, 3, 0.25f, 3, -1, 0.25f, -1, -1, 0.25f};
    const uint32_t indices[] = {0, 1, 2};
    const Buffer positions = pass_list.buffer("positions", sizeof clip),
                 index_buffer = pass_list.buffer("indices", sizeof indices);
    pass_list.upload(positions, std::as_bytes(std::span(clip)));
    pass_list.upload(index_buffer, std::as_bytes(std::span(indices)));
    const Image color = pass_list.image("color", Format::rgba32f),
                tint = pass_list.image_of("tint", Format::rgba8, {1, 1});
    pass_list.upload_rgba8(tint, std::vector<uint8_t>{0, 255, 0, 255});
    const auto drawn = [&](DepthTest::Compare compare, float clear, Format format, Draw::Cull cull) {
        const Image depth = pass_list.image("depth_buffer", format);
        pass_list.clear(depth, {clear, 0, 0, 0});
        pass_list.clear(color, glm::vec4(-1.0f));
        std::vector<Draw> draws(2, {.indices = index_buffer,
                                    .index_count = 3,
                                    .first_instance = 8,
                                    .cull = cull,
                                    .reads = {{tint, {}}},
                                    .buffers = {positions}});
        draws[0].vertex_offset = 3;  // the nearer one first, so that order alone would give the farther
        draws[1].first_instance = 3;
        pass_list.draw("triangle.vert", "instance_color.frag", draws)
            .depth({.compare = compare, .image = depth})
            .write(color)
            .run();
        const float stored = pass_list.download(depth).pixel(8, 6)[0];
        return std::array<float, 3>{pass_list.download(color).pixel(8, 6)[0], pass_list.download(color).pixel(8, 6)[1],
                                    stored};
    };
    using Compare = DepthTest::Compare;
    EXPECT_EQ(drawn(Compare::less, 1.0f, Format::d32f, Draw::Cull::none), (std::array<float, 3>{8, 1, 0.25f}));
    EXPECT_EQ(drawn(Compare::greater, 0.0f, Format::d32f, Draw::Cull::none), (std::array<float, 3>{3, 1, 0.75f}));
    EXPECT_EQ(drawn(Compare::always, 1.0f, Format::d32f, Draw::Cull::none)[0], 3.0f);
    // In the image (y down) these corners run bottom left, top right, top left: counter-clockwise, a front face.
    EXPECT_EQ(drawn(Compare::less, 1.0f, Format::d32f, Draw::Cull::back)[0], 8.0f);
    EXPECT_EQ(drawn(Compare::less, 1.0f, Format::d32f, Draw::Cull::front)[0], -1.0f);
    EXPECT_NEAR(drawn(Compare::less, 1.0f, Format::d16, Draw::Cull::none)[2], 0.25f,
                0.5f / 65535.0f + 1e-7f);  // half a step of D16
    if (device.supports(Format::d24)) {
        EXPECT_NEAR(drawn(Compare::less, 1.0f, Format::d24, Draw::Cull::none)[2], 0.25f, 0.5f / 16777215.0f + 1e-7f);
    }
}

TEST_F(Graph, UploadsAndDownloadsEachFormat) {
    PassList pass_list(device, {5, 3});
    begin(pass_list);
    const auto round_trip = [&](Format format, const HostImage& pixels) {
        const Image image = pass_list.image("format" + std::to_string(int(format)), format);
        pass_list.upload(image, pixels);
        return pass_list.download(image).values;
    };
    for (const auto& [format, channels] : {std::pair(Format::r32f, 1u), {Format::rg32f, 2u}, {Format::rgba32f, 4u}})
        EXPECT_EQ(round_trip(format, ramp({5, 3}, channels, 0.1f)), ramp({5, 3}, channels, 0.1f).values);
    for (const auto& [format, channels] :
         {std::pair(Format::r16f, 1u),
          {Format::rg16f, 2u},
          {Format::rgba16f, 4u},
          {Format::r11g11b10f, 3u},
          {Format::r32ui, 1u}})  // 0 .. 59: r11g11b10f holds six bits, five for blue, after the leading one
        EXPECT_EQ(round_trip(format, ramp({5, 3}, channels, 1.0f)),
                  ramp({5, 3}, channels, 1.0f).values);  // small integers are exact in all
    for (const auto& [format, channels] : {std::pair(Format::r8, 1u), {Format::rg8, 2u}, {Format::rgba8, 4u}}) {
        HostImage bytes = ramp({5, 3}, channels, 1.0f);
        for (float& v : bytes.values) v /= 255.0f;
        EXPECT_EQ(round_trip(format, bytes), bytes.values);
    }
}

/// Also where a shader of another text, or of the same one, was compiled before.
TEST_F(Graph, PassesDecideWhatAnIncludeStandsFor) {
    PassList pass_list(device, {4, 4});
    begin(pass_list);
    const Image color = pass_list.image("color", Format::rgba32f);
    const auto drawn = [&](const std::string& glsl) {
        pass_list.fragment("decided_include.frag").include("decided", glsl).write(color).run();
        return pass_list.download(color).values.front();
    };
    const std::string three = "float decided() { return 3.0; }\n", five = "float decided() { return 5.0; }\n",
                      of_file =
                          "#include \"core/shaders/view.glsl\"\n"
                          "float decided() { return is_background(camera.depth.z) ? 7.0 : 8.0; }\n",
                      no_glsl_es = "float decided() { return 3; }\n";
    EXPECT_EQ(drawn(three), 3.0f);
    EXPECT_EQ(drawn(five), 5.0f);
    EXPECT_EQ(drawn(three), 3.0f);
    EXPECT_EQ(drawn(no_glsl_es), 3.0f);
    {
        const LimitScope limits(pass_list, Limits::webgl2);
        EXPECT_EQ(drawn(five), 5.0f);
        EXPECT_EQ(drawn(of_file), 7.0f);
        const std::string refused = error_message([&] { drawn(no_glsl_es); });
        EXPECT_NE(refused.find("GLSL ES 3.00"), std::string::npos) << refused;
        EXPECT_NE(refused.find("decided:1"), std::string::npos) << refused;
    }
    const std::string undecided = error_message([&] { pass_list.fragment("decided_include.frag").write(color).run(); });
    EXPECT_NE(undecided.find("which decided_include.frag:1 includes"), std::string::npos) << undecided;
}

TEST_F(Graph, MistakesNameTheCulprit) {
    PassList pass_list(device, {16, 16});
    begin(pass_list);
    const Image sum = pass_list.image("sum", Format::rgba32f), other = pass_list.image("other", Format::rgba32f),
                unwritten = pass_list.image("previous_sum", Format::rgba32f);
    EXPECT_EQ(error_message([&] { pass_list.compute("add_one.comp").write(sum).run(); }),
              "add_one.comp uses 'previous_sum', which the pass does not provide; it provides: sum");
    EXPECT_EQ(error_message([&] { pass_list.compute("add_one.comp").read(unwritten).write(sum).run(); }),
              "pass add_one reads 'previous_sum', which nothing has written yet");
    pass_list.clear(unwritten, glm::vec4(0.0f));
    EXPECT_EQ(error_message([&] { pass_list.compute("add_one.comp").read(unwritten).read(other).write(sum).run(); }),
              "pass add_one reads 'other', which add_one.comp does not use");
    EXPECT_NE(
        error_message([&] { pass_list.compute("no_such.comp").write(sum).run(); }).find("no shader file no_such.comp"),
        std::string::npos);
}

TEST(Devices, AreChosenByIndexOrName) {
    const auto devices = list_devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_EQ(Device("0").info().name, devices[0].name);
    EXPECT_EQ(Device(devices[0].name.substr(0, 4)).info().name, devices[0].name);
    EXPECT_NE(error_message([] { Device("no such device"); }).find("no Vulkan device fits 'no such device'"),
              std::string::npos);
}

TEST(Validation, ReportsMisuse) {
    // Shows that silence elsewhere means something: a dispatch over the device's limit must be reported.
    Device device("", true);
    PassList pass_list(device, {8, 8});
    const ParameterSet none;
    pass_list.begin_frame({}, none, {});
    const Image sum = pass_list.image("sum", Format::rgba32f),
                before = pass_list.image("previous_sum", Format::rgba32f);
    pass_list.clear(before, glm::vec4(0.0f));
    EXPECT_TRUE(device.validation_messages().empty());
    pass_list.compute("add_one.comp").read(before).write(sum).dispatch_groups({0, 0, 70000});
    EXPECT_FALSE(device.validation_messages().empty());
}
