#include "core/gpu/passes/limits.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_list.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <functional>

namespace {

struct Webgl2Limits : testing::Test {
    Device device;
    PassList pass_list{device, {8, 8}};
    const ParameterSet no_parameters;
    const Image color = pass_list.image("color", Format::rgba16f), source = pass_list.image("source", Format::rgba16f);

    void SetUp() override {
        pass_list.begin_frame({}, no_parameters, {});
        pass_list.clear(source, {});
    }
    /// What is refused reaches no command buffer, and so not the validation layer either.
    void TearDown() override { EXPECT_EQ(device.validation_messages(), std::vector<std::string>()); }

    std::string message(const std::function<void()>& action) {
        const LimitScope limits(pass_list, Limits::webgl2);
        return error_message(action);
    }
};

constexpr Format all_formats[] = {Format::r8,    Format::rg8,     Format::rgba8,      Format::rgba8_srgb,
                                  Format::r16f,  Format::rg16f,   Format::rgba16f,    Format::r32f,
                                  Format::rg32f, Format::rgba32f, Format::r11g11b10f, Format::r32ui,
                                  Format::d32f,  Format::d24,     Format::d16,        Format::d32f_s8};

}  // namespace

TEST_F(Webgl2Limits, RefuseComputeShadersWhileTheScopeLasts) {
    const Image sum = pass_list.image("sum", Format::rgba32f),
                before = pass_list.image("previous_sum", Format::rgba32f);
    pass_list.clear(before, {});
    const auto add = [&] { pass_list.compute("add_one.comp").read(before).write(sum).run(); };
    EXPECT_EQ(message(add),
              "pass add_one is a compute shader, outside the limits of WebGL 2, which has vertex and fragment shaders "
              "only");
    const Buffer groups = pass_list.buffer("groups", 12);
    EXPECT_EQ(message([&] { pass_list.compute("add_one.comp").read(before).write(sum).dispatch(groups); }),
              message(add));
    add();
    EXPECT_EQ(pass_list.download(sum).values.front(), 1.0f);
    const LimitScope outer(pass_list, Limits::webgl2);
    { const LimitScope inner(pass_list, Limits::none); }
    EXPECT_THROW(add(), Error);
}

TEST_F(Webgl2Limits, RefuseStorageImages) {
    const Image target = pass_list.image("target", Format::rgba16f);
    EXPECT_EQ(message([&] { pass_list.fragment("image_store.frag").write(target).run(); }),
              "pass image_store uses the storage image 'target', outside the limits of WebGL 2, which writes to colour "
              "targets only");
}

TEST_F(Webgl2Limits, RefuseStorageBuffers) {
    const Buffer counts = pass_list.buffer("counts", 4);
    EXPECT_EQ(message([&] { pass_list.fragment("storage_buffer.frag").use(counts).write(color).run(); }),
              "pass storage_buffer uses the storage buffer 'counts', outside the limits of WebGL 2, which has no such "
              "buffers");
    const std::string of_buffer =
        "the storage buffer 'counts' lies outside the limits of WebGL 2, which has no such buffers";
    EXPECT_EQ(message([&] { pass_list.clear(counts, 0); }), of_buffer);
    EXPECT_EQ(message([&] { pass_list.upload(counts, std::vector<std::byte>(4)); }), of_buffer);
}

TEST_F(Webgl2Limits, RefuseMeshesFromBuffers) {
    const std::vector<Draw> draws = {{.indices = pass_list.buffer("indices", 12), .index_count = 3}};
    EXPECT_EQ(message([&] { pass_list.draw("triangle.vert", "instance_color.frag", draws).write(color).run(); }),
              "pass instance_color draws meshes, whose vertices lie in storage buffers, outside the limits of WebGL 2, "
              "which has no such buffers");
}

TEST_F(Webgl2Limits, RefuseAFifthColorTarget) {
    const auto write = [&](const std::string& shader, const std::string& names) {
        auto pass = pass_list.fragment(shader);
        for (const char name : names) pass.write(pass_list.image(std::string(1, name), Format::rgba16f));
        pass.run();
    };
    EXPECT_EQ(message([&] { write("four_targets.frag", "abcd"); }), "no error");
    EXPECT_EQ(message([&] { write("five_targets.frag", "abcde"); }),
              "pass five_targets draws to 5 colour targets, the last of them 'e', outside the limits of WebGL 2, which "
              "guarantees 4");
}

TEST_F(Webgl2Limits, RefuseTheSeventeenthTexture) {
    const auto read = [&](const std::string& shader, unsigned count) {
        auto pass = pass_list.fragment(shader);
        for (unsigned i = 0; i < count; ++i) pass.read(source.as("t" + std::to_string(i)));
        pass.write(color).run();
    };
    EXPECT_EQ(message([&] { read("sixteen_textures.frag", 16); }), "no error");
    EXPECT_EQ(message([&] { read("seventeen_textures.frag", 17); }),
              "pass seventeen_textures reads 17 textures, outside the limits of WebGL 2, which guarantees 16");
}

/// A float is drawn to every colour format but the one of integers, which a float output does not fit.
TEST_F(Webgl2Limits, RefuseColorTargetsOfOtherFormats) {
    for (const Format format : all_formats) {
        if (format == Format::r32ui || !device.supports(format)) continue;
        const Image target = pass_list.image("target", format).as("color");
        const std::string result = message(
            [&] { pass_list.fragment("constant_color.frag").set("value", glm::vec4(1.0f)).write(target).run(); });
        const bool is_depth = format >= Format::d32f;
        EXPECT_EQ(result == "no error", !is_depth) << int(format) << result;
        if (format == Format::d16) {
            EXPECT_EQ(result,
                      "pass constant_color has the colour target 'color' of format DEPTH_COMPONENT16, outside the "
                      "limits of WebGL 2, which with EXT_color_buffer_float has R8, RG8, RGBA8, SRGB8_ALPHA8, R16F, "
                      "RG16F, RGBA16F, R32F, RG32F, RGBA32F, R11F_G11F_B10F, R32UI");
        }
    }
}

TEST_F(Webgl2Limits, RefuseToFilterFloatsOf32Bits) {
    const std::string filtered =
        ", outside the limits of WebGL 2, which filters R8, RG8, RGBA8, SRGB8_ALPHA8, R16F, RG16F, RGBA16F, "
        "R11F_G11F_B10F";
    for (const auto& [format, name] : {std::pair(Format::r8, ""),
                                       {Format::rg8, ""},
                                       {Format::rgba8, ""},
                                       {Format::rgba8_srgb, ""},
                                       {Format::r16f, ""},
                                       {Format::rg16f, ""},
                                       {Format::rgba16f, ""},
                                       {Format::r11g11b10f, ""},
                                       {Format::r32f, "R32F"},
                                       {Format::rg32f, "RG32F"},
                                       {Format::rgba32f, "RGBA32F"},
                                       {Format::d32f, "DEPTH_COMPONENT32F"},
                                       {Format::d16, "DEPTH_COMPONENT16"}}) {
        const Image image = pass_list.image("image", format).as("source");
        pass_list.clear(image, {});
        EXPECT_EQ(message([&] { pass_list.fragment("plain_webgl2.frag").read(image).write(color).run(); }), "no error");
        const std::string expected =
            *name ? "pass plain_webgl2 filters 'source' of format " + std::string(name) + " linearly" + filtered
                  : "no error";
        EXPECT_EQ(message([&] { pass_list.fragment("plain_webgl2.frag").read_linear(image).write(color).run(); }),
                  expected);
    }
}

TEST_F(Webgl2Limits, RefuseToReadWhatIsDrawnTo) {
    const std::string only_others = ", outside the limits of WebGL 2, which reads no image while it is drawn to";
    const Image pyramid = pass_list.image_of("pyramid", Format::rgba16f, {8, 8}, 3);
    pass_list.clear(pyramid, {});
    const auto draw = [&](const Image& read, const Image& write) {
        return message([&] { pass_list.fragment("plain_webgl2.frag").read(read).write(write).run(); });
    };
    const std::string color_too = "pass plain_webgl2 reads 'source' and draws to it as 'color'" + only_others;
    EXPECT_EQ(draw(pyramid.as("source"), pyramid.mip(1).as("color")), color_too);
    EXPECT_EQ(draw(pyramid.mip(2).as("source"), pyramid.mip(1).as("color")), color_too);
    EXPECT_EQ(draw(source, pyramid.mip(1).as("color")), "no error");

    const Image depth = pass_list.image("depth_buffer", Format::d32f), mask = pass_list.image("mask", Format::d32f_s8);
    pass_list.clear(depth, {}), pass_list.clear(mask, {});
    EXPECT_EQ(message([&] {
                  pass_list.fragment("plain_webgl2.frag")
                      .read(depth.as("source"))
                      .depth({.is_written = false, .image = depth})
                      .write(color)
                      .run();
              }),
              "pass plain_webgl2 reads 'source' and draws to it as 'depth_buffer'" + only_others);
    EXPECT_EQ(message([&] {
                  pass_list.fragment("plain_webgl2.frag")
                      .read(mask.as("source"))
                      .stencil({Stencil::Mode::keep_equal, 0, mask})
                      .write(color)
                      .run();
              }),
              "pass plain_webgl2 reads 'source' and draws to it as 'mask'" + only_others);
}

/// What a G-buffer or another input offers by name counts like what the pass itself names.
TEST_F(Webgl2Limits, HoldForInputsToo) {
    const Image inputs[] = {color.as("source")};
    pass_list.clear(color, {});
    pass_list.begin_frame({}, no_parameters, inputs);
    EXPECT_NE(
        message([&] { pass_list.fragment("plain_webgl2.frag").write(color).run(); }).find("reads 'source' and draws"),
        std::string::npos);
}

TEST_F(Webgl2Limits, RefuseViewsOfSomeMips) {
    const Image pyramid = pass_list.image_of("pyramid", Format::rgba16f, {8, 8}, 3).as("source");
    pass_list.clear(pyramid, {});
    const auto read = [&](const Image& image) {
        return message([&] { pass_list.fragment("plain_webgl2.frag").read(image).write(color).run(); });
    };
    EXPECT_EQ(read(pyramid), "no error");
    EXPECT_EQ(read(pyramid.mip(0)),
              "pass plain_webgl2 reads 1 of the 3 mips of 'source', outside the limits of WebGL 2, which has no views "
              "of textures and reads all mips");
}

TEST_F(Webgl2Limits, RefuseDepthAndStencilInTwoImages) {
    const Image depth = pass_list.image("depth_buffer", Format::d16), mask = pass_list.image("mask", Format::d32f_s8);
    const auto test = [&](const Image& depth_image) {
        return message([&] {
            pass_list.fragment("constant_color.frag")
                .set("value", glm::vec4(1.0f))
                .depth({.image = depth_image})
                .stencil({Stencil::Mode::keep_equal, 0, mask})
                .write(color)
                .run();
        });
    };
    pass_list.clear(mask, {});
    EXPECT_EQ(test(mask), "no error");
    EXPECT_EQ(test(depth),
              "pass constant_color tests depth in 'depth_buffer' and stencil in 'mask', outside the limits of WebGL 2, "
              "which keeps both in one image");
}

TEST_F(Webgl2Limits, RefuseUploadsToDepthWithStencil) {
    const HostImage pixels({8, 8}, 1);
    EXPECT_EQ(message([&] { pass_list.upload(pass_list.image("depth_buffer", Format::d32f), pixels); }), "no error");
    EXPECT_EQ(
        message([&] { pass_list.upload(pass_list.image("mask", Format::d32f_s8), pixels); }),
        "the upload to 'mask' of format DEPTH32F_STENCIL8 lies outside the limits of WebGL 2, which only draws and "
        "clears such images");
}

TEST_F(Webgl2Limits, RefuseShadersThatAreNoGlslEs) {
    const auto draw = [&] { pass_list.fragment("implicit_conversion.frag").write(color).run(); };
    for (int i = 0; i < 2; ++i) {  // what was refused once is refused again
        const std::string result = message(draw);
        EXPECT_EQ(result.rfind("pass implicit_conversion has a shader of another language, outside the limits of WebGL "
                               "2, which takes GLSL ES 3.00: cannot compile implicit_conversion.frag:\n",
                               0),
                  0u)
            << result;
        EXPECT_NE(result.find("implicit_conversion.frag:3: '='"), std::string::npos) << result;
    }
    draw();
}
