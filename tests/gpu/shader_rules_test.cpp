// What a shader may ask for. Each case is valid GLSL, which ran before it was refused.
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_list.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>

namespace {

const std::string target = "uniform writeonly image2D target;\n", store = "imageStore(target, pixel, vec4(1.0));\n";

struct ShaderRules : testing::Test {
    Device device;
    PassList pass_list{device, {8, 8}};
    ParameterSet no_parameters;
    CameraData camera{};

    void TearDown() override { EXPECT_EQ(device.validation_messages(), std::vector<std::string>()); }

    /// What the pass fails with. It reads the images `source` and `ids`, as far as the shader names them.
    std::string error_of(const std::string& declarations, const std::string& lines) {
        pass_list.begin_frame(camera, no_parameters, {});
        const Image source = pass_list.image("source", Format::rgba32f), ids = pass_list.image("ids", Format::r32ui);
        pass_list.clear(source, glm::vec4(2));
        pass_list.clear(ids, glm::vec4(0));
        return error_message([&] {
            auto pass = pass_list.compute("decided_lines.comp");
            pass.include("declarations", declarations).include("lines", lines);
            if (declarations.find(" source") != std::string::npos) pass.read(source);
            if (declarations.find(" ids;") != std::string::npos) pass.read(ids);
            if (declarations.find(" number;") != std::string::npos) pass.set("number", 1.0f);
            pass.write(pass_list.image("target", Format::rgba32f)).run();
        });
    }
    void expect_refusal(const std::string& declarations, const std::string& lines, const std::string& because) {
        const std::string error = error_of(declarations, lines);
        EXPECT_NE(error.find(because), std::string::npos) << error << "\nlacks: " << because;
    }
};

}  // namespace

TEST_F(ShaderRules, WhatDevicesHaveIsTaken) {
    EXPECT_EQ(error_of(target + "uniform sampler2D source;\nuniform usampler2D ids;\n",
                       "imageStore(target, pixel, texelFetch(source, pixel, 0) + texelFetch(ids, pixel, 0).x);\n"),
              "no error");
    EXPECT_EQ(error_of("layout(binding = 3) " + target + "layout(binding = 1) uniform sampler2D source;\n",
                       "imageStore(target, pixel, texelFetch(source, pixel, 0));\n"),
              "no error");
}

TEST_F(ShaderRules, CapabilitiesOfNoDeviceAreRefusedWithThePlace) {
    const std::string any_address =
        "\n#extension GL_EXT_buffer_reference : require\n"
        "layout(buffer_reference, std430) buffer Words { uint word; };\n"
        "layout(push_constant) uniform Push { Words words; };\n" +
        target;
    expect_refusal(any_address, "if (pixel.x < 0) words.word = 1u;\n" + store, "PhysicalStorageBufferAddresses");
    expect_refusal(any_address, "if (pixel.x < 0) words.word = 1u;\n" + store,
                   "declarations:2: #extension GL_EXT_buffer_reference : require");
    expect_refusal("#extension GL_ARB_shader_clock : require\n" + target,
                   "imageStore(target, pixel, vec4(clock2x32ARB().xyxy));\n", "SPV_KHR_shader_clock");
    expect_refusal("#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require\n" + target,
                   "uint64_t big = uint64_t(pixel.x);\nimageStore(target, pixel, vec4(float(big >> 3)));\n", "Int64");
    expect_refusal(target + "uniform sampler2D source;\n",
                   "imageStore(target, pixel, textureGatherOffset(source, vec2(0.5), pixel));\n",
                   "ImageGatherExtended");
}

TEST_F(ShaderRules, EachResourceHasABindingOfItsOwn) {
    const std::string copy = "imageStore(target, pixel, texelFetch(source, pixel, 0));\n";
    expect_refusal("layout(binding = 0) " + target + "layout(binding = 0) uniform sampler2D source;\n", copy,
                   "have the same binding 0");
    expect_refusal("layout(binding = 5) " + target + "layout(std430, binding = 5) buffer List { uint list[]; };\n",
                   "list[0] = 1u;\n" + store, "have the same binding 5");
    expect_refusal("layout(set = 1) " + target, store,
                   "'target' has a descriptor set of its own; leave out its set = 1");
}

TEST_F(ShaderRules, ImagesHaveTheKindOfThePass) {
    const auto as = [&](const std::string& kind, const std::string& name, const std::string& fetch) {
        return error_of(target + "uniform " + kind + " " + name + ";\n",
                        "imageStore(target, pixel, vec4(" + fetch + "));\n");
    };
    EXPECT_EQ(as("sampler2D", "source", "texelFetch(source, pixel, 0)"), "no error");
    for (const auto& [kind, name, fetch] :
         {std::array{"sampler3D", "source", "texelFetch(source, ivec3(pixel, 3), 0)"},
          std::array{"sampler2DArray", "source", "texelFetch(source, ivec3(pixel, 3), 0)"},
          std::array{"usampler2D", "source", "texelFetch(source, pixel, 0)"},
          std::array{"isampler2D", "ids", "texelFetch(ids, pixel, 0)"},
          std::array{"sampler2D", "ids", "texelFetch(ids, pixel, 0)"},
          std::array{"samplerCube", "source", "texture(source, vec3(1.0))"},
          std::array{"sampler2DShadow", "source", "texture(source, vec3(0.5))"}})
        EXPECT_NE(as(kind, name, fetch).find("declares '" + std::string(name) + "' as " + kind), std::string::npos)
            << as(kind, name, fetch);
    expect_refusal(target + "uniform sampler2D source[2];\n",
                   "imageStore(target, pixel, texelFetch(source[1], pixel, 0));\n", "as sampler2D[]");
    expect_refusal("layout(rgba32f) uniform writeonly image3D target;\n",
                   "imageStore(target, ivec3(pixel, 1), vec4(1.0));\n", "declares 'target' as image3D");
    expect_refusal("layout(r32ui) uniform writeonly uimage2D target;\n", "imageStore(target, pixel, uvec4(1u));\n",
                   "declares 'target' as uimage2D");
    expect_refusal("layout(std430) buffer target { uint words[]; };\n", "words[0] = 1u;\n",
                   "declares the block 'target', and the pass has an image of this name");
    EXPECT_NE(as("samplerBuffer", "source", "texelFetch(source, pixel.x)"), "no error");
}

/// The pass would write beyond the block.
TEST_F(ShaderRules, NumbersHaveTheSizeThatTheShaderDeclares) {
    EXPECT_EQ(error_of("layout(push_constant) uniform Push { float number; };\n" + target,
                       "imageStore(target, pixel, vec4(number));\n"),
              "no error");
    expect_refusal("layout(push_constant) uniform Push { vec4 number; };\n" + target,
                   "imageStore(target, pixel, number);\n",
                   "sets 'number' of 4 bytes, and decided_lines.comp declares 16 bytes");
}
