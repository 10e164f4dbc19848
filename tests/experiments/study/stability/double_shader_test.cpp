#include "experiments/study/stability/precision/double_shader.h"
#include "core/gpu/device.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace {

struct DoubleFunctions : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    ParameterSet no_parameters;
    CameraData camera{};
    PassList pass_list{device(), {64, 1}};

    void SetUp() override { pass_list.begin_frame(camera, no_parameters, {}); }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }

    /// Value and remainder of tests/shaders/double_functions.comp at -8 ... 8.
    std::vector<double> values_of(unsigned function, bool is_double) {
        HostImage arguments(pass_list.extent(), 1);
        for (size_t i = 0; i < arguments.values.size(); ++i) arguments.values[i] = argument(i);
        const Image argument = pass_list.image("argument", Format::r32f),
                    value = pass_list.image("value", Format::rg32f);
        pass_list.upload(argument, arguments);
        pass_list.set_changes(
            {.format_of = {}, .glsl_of = double_where([=](const std::string&) { return is_double; })});
        pass_list.compute("double_functions.comp").read(argument).write(value).set("function", function).run();
        const HostImage parts = pass_list.download(value);
        std::vector<double> values;
        for (size_t i = 0; i < arguments.values.size(); ++i)
            values.push_back(double(parts.values[2 * i]) + double(parts.values[2 * i + 1]));
        return values;
    }
    static float argument(size_t i) { return (float(i) - 31.7f) / 4.0f; }
};

}  // namespace

/// Against the host's functions: 4e-15 of the value's size, of which the library's own errors are a part, and near
/// zeros 1e-15 of 1.
TEST_F(DoubleFunctions, AreRightToFifteenDigits) {
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
