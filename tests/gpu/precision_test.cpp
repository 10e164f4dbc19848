#include "core/gpu/pipelines/precision.h"
#include "core/gpu/device.h"
#include "core/gpu/pass_graph.h"
#include "core/gpu/pipelines/double_shader.h"

#include <Imath/half.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace {

struct PrecisionTest : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    ParameterSet no_parameters;
    CameraData camera{};
    PassGraph graph{device(), {64, 1}};

    void SetUp() override { graph.begin_frame(camera, no_parameters, {}); }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }

    Image stored(const std::string& name, Format format, glm::vec4 value) {
        const Image image = graph.image(name, format);
        graph.compute("store_value.comp").write(image.as("target")).set("value", value).run();
        return image;
    }

    /// Value and remainder of tests/shaders/double_functions.comp at -8 ... 8.
    std::vector<double> values_of(unsigned function, bool is_double) {
        HostImage arguments(graph.extent(), 1);
        for (size_t i = 0; i < arguments.values.size(); ++i) arguments.values[i] = argument(i);
        const Image argument = graph.image("argument", Format::r32f), value = graph.image("value", Format::rg32f);
        graph.upload(argument, arguments);
        graph.set_precision({.format_of = {}, .is_double = [=](const std::string&) { return is_double; }});
        graph.compute("double_functions.comp").read(argument).write(value).set("function", function).run();
        const HostImage parts = graph.download(value);
        std::vector<double> values;
        for (size_t i = 0; i < arguments.values.size(); ++i)
            values.push_back(double(parts.values[2 * i]) + double(parts.values[2 * i + 1]));
        return values;
    }
    static float argument(size_t i) { return (float(i) - 31.7f) / 4.0f; }
};

}  // namespace

/// The known error of known values: 1 + 2^-12 is 1 in half, 0.3 lies between two halves. Vulkan leaves it to the device
/// whether it rounds or, as lavapipe, cuts off.
TEST_F(PrecisionTest, ImagesAreMadeInTheFormatsThatThePolicyNames) {
    graph.set_precision({.format_of = [](const std::string& image,
                                         Format asked) { return image == "kept" ? asked : as_float16(asked); },
                         .is_double = {}});
    const glm::vec4 value(1.0f + 1.0f / 4096.0f, 0.3f, 1e5f, 1e-8f);
    const Image kept = stored("kept", Format::rgba32f, value), rounded = stored("rounded", Format::rgba32f, value);
    EXPECT_EQ(kept.format, Format::rgba32f);
    EXPECT_EQ(rounded.format, Format::rgba16f);
    const HostImage a = graph.download(kept), b = graph.download(rounded);
    EXPECT_EQ(std::vector(a.values.begin(), a.values.begin() + 4), (std::vector{value.x, value.y, value.z, value.w}));
    EXPECT_EQ(b.values[0], 1.0f);
    const float nearest = half(0.3f), below = nearest - std::exp2(-12.0f);  // halves are 2^-12 apart there
    EXPECT_TRUE(b.values[1] == nearest || b.values[1] == below) << b.values[1];
    EXPECT_GE(b.values[2], 65504.0f);  // devices store the largest half, or infinity
    EXPECT_EQ(b.values[3], 0.0f);

    graph.set_precision({});
    EXPECT_EQ(graph.image("rounded", Format::rgba32f).format, Format::rgba32f);
}

TEST_F(PrecisionTest, HistoriesHaveOneNameAndTwoSides) {
    std::vector<std::string> asked;
    graph.set_precision({.format_of =
                             [&](const std::string& image, Format format) {
                                 asked.push_back(image);
                                 return as_float32(format);
                             },
                         .is_double = {}});
    const PassGraph::History history = graph.history("kept", Format::r8);
    EXPECT_EQ(asked, (std::vector<std::string>{"kept", "kept"}));
    EXPECT_EQ(history.previous.format, Format::r32f);
    EXPECT_EQ(graph.asked_name(history.previous), "kept");
    EXPECT_EQ(graph.asked_name(graph.image("other", Format::r8).as("kept")), "other");
    EXPECT_EQ(graph.asked_name(Image{}), "");
}

TEST_F(PrecisionTest, EveryFormatHasItsNameAndItsKin) {
    for (const Format format : {Format::r8, Format::rg8, Format::rgba8, Format::r16f, Format::rg16f, Format::rgba16f,
                                Format::r32f, Format::rg32f, Format::rgba32f, Format::r11g11b10f}) {
        const std::string name = name_of(format), wide = name_of(as_float32(format)),
                          narrow = name_of(as_float16(format));
        const std::string channels =
            format == Format::r11g11b10f ? "rgba" : name.substr(0, name.find_first_of("0123456789"));
        EXPECT_EQ(wide, channels + "32f") << name;
        EXPECT_EQ(narrow, channels + "16f") << name;
    }
    for (const Format format : {Format::r32ui, Format::d32f, Format::d24, Format::d16, Format::d32f_s8})
        EXPECT_TRUE(as_float32(format) == format && as_float16(format) == format) << name_of(format);
}

/// Against the host's functions: 4e-15 of the value's size, of which the library's own errors are a part, and near
/// zeros 1e-15 of 1.
TEST_F(PrecisionTest, DoubleFunctionsAreRightToFifteenDigits) {
    const auto expected = [](unsigned function, double x) {
        switch (function) {
            case 0:
                return std::exp2(x);
            case 1:
                return std::exp(x);
            case 2:
                return std::log2(std::abs(x));
            case 3:
                return std::log(std::abs(x));
            case 4:
                return std::pow(std::abs(x), 1.7);
            case 5:
                return std::sin(x);
            case 6:
                return std::cos(x);
            case 7:
                return std::atan(x);
            case 8:
                return std::atan2(x, -0.75);
            case 9:
                return std::acos(std::clamp(x, -1.0, 1.0));
            default:
                return 1.0 / 3.0 + x;
        }
    };
    for (unsigned function = 0; function <= 10; ++function) {
        const std::vector<double> wide = values_of(function, true), narrow = values_of(function, false);
        double wide_error = 0, narrow_error = 0;
        for (size_t i = 0; i < wide.size(); ++i) {
            const double truth = expected(function, double(argument(i))), size = std::max(std::abs(truth), 0.25);
            wide_error = std::max(wide_error, std::abs(wide[i] - truth) / size);
            narrow_error = std::max(narrow_error, std::abs(narrow[i] - truth) / size);
        }
        EXPECT_LT(wide_error, 4e-15) << function;
        EXPECT_GT(narrow_error, 1e-8) << function << ": floats are that exact?";
    }
}

TEST(DoubleShader, WhatLiesOutsideOfTheShaderKeepsItsFloats) {
    const std::string converted = in_double(R"(
layout(constant_id = 3) const float chosen = float(0.5);
struct Kept { vec3 a; float b; uint c; };
struct Own { vec2 v; };
layout(std430) buffer many { Kept kept_of[]; };
buffer some { vec4 some_of[]; };
layout(std140) uniform Params { float p; };
uniform sampler2D image;
shared float tile[4];
layout(location = 0) out vec4 color;
Own made(float x, inout Own own) { return Own(vec2(x, 0.1f) * mat2(1.0, 0.0, 0.0, 1e-3)); }
void main() {
    some_of[2] = vec4(1.0);
    bool same = some_of[1] == vec4(2);
    kept_of[0] = Kept(vec3(p), 2.0, 7u);
    color.xy = made(chosen, own).color;
    gl_FragDepth = .5;
}
)",
                                            "");
    for (const char* text :
         {"layout(constant_id = 3) const float chosen = float(0.5);", "struct Kept { vec3 a; float b; uint c; };",
          "struct Own { dvec2 v; };", "buffer some { vec4 some_of[]; };", "uniform Params { float p; };",
          "shared double tile[4];", "layout(location = 0) out vec4 color;",
          "Own made(double x, inout Own own) { return Own(dvec2(x, 0.1LF) * dmat2(1.0LF, 0.0LF, 0.0LF, 1e-3LF)); }",
          "some_of[2] = vec4( dvec4(1.0LF));", "bool same = some_of[1] == dvec4(2);",
          "Kept wide_Kept(dvec3 a, double b, uint c) { return Kept(vec3(a), float(b), c); }",
          "kept_of[0] = wide_Kept(dvec3(p), 2.0LF, 7u);", "wide_color.xy = made(chosen, own).color;",
          "wide_gl_FragDepth = .5LF;", "void wide_main() {", "dvec4 wide_color;", "color = vec4(wide_color);",
          "gl_FragDepth = float(wide_gl_FragDepth);"})
        EXPECT_NE(converted.find(text), std::string::npos) << text << "\n" << converted;
}

TEST(DoubleShader, DeclaredFormatsFollowTheImages) {
    const std::string shader =
        "layout(r32f) uniform coherent image2D kept, other;\nlayout(rgba32f) uniform writeonly image2D third;\n";
    EXPECT_EQ(with_image_formats(shader, {{"other", Format::r16f}}),
              "layout(r16f) uniform coherent image2D kept, other;\nlayout(rgba32f) uniform writeonly image2D third;\n");
    EXPECT_EQ(with_image_formats(shader, {{"image2D_", Format::r16f}}), shader);
}
