#include "core/gpu/pipelines/shader.h"
#include "core/error.h"
#include "core/files.h"
#include "core/parameters.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

namespace {

std::string error_of(const std::string& file, ShaderLanguage language = ShaderLanguage::vulkan) {
    return error_message([&] { compile(file, "", "", {}, language); });
}

}  // namespace

TEST(Shader, ErrorsNameTheFileAndLineAsWritten) {
    EXPECT_NE(error_of("broken_include.comp").find("broken_part.glsl:3: 'undeclared'"), std::string::npos);
    EXPECT_NE(error_of("broken.comp").find("broken.comp:5: 'nor_this'"), std::string::npos) << error_of("broken.comp");
    EXPECT_NE(error_of("broken_include.comp").find("(included by broken_include.comp:"), std::string::npos)
        << error_of("broken_include.comp");
    EXPECT_EQ(error_of("broken_include.comp").find(": '' :"), std::string::npos) << error_of("broken_include.comp");
    EXPECT_NE(error_of("amd_sssr").find("no shader file amd_sssr, under"), std::string::npos) << "a folder";
    EXPECT_NE(error_of("no_such.comp").find("no shader file no_such.comp, under"), std::string::npos);
    EXPECT_NE(error_of("missing_include.comp")
                  .find("no shader file no_such_part.glsl, which missing_include.comp:2 includes, under"),
              std::string::npos)
        << error_of("missing_include.comp");
}

TEST(Shader, AFileThatIncludesItselfIsNamedWithThePlace) {
    const auto error = [](const std::string& first, const std::string& second) {
        return error_message([&] {
            compile("missing_include.comp", "", "",
                    {{"no_such_part.glsl", "#include \"a\"\n"}, {"a", first}, {"b", second}});
        });
    };
    EXPECT_NE(error("\n#include \"b\"\n", "#include \"a\"\n").find("a includes itself, at b:1"), std::string::npos);
    EXPECT_NE(error("#include \"a\"\n", "").find("a includes itself, at a:1"), std::string::npos);
    EXPECT_EQ(error("#include \"b\"\n#include \"b\"\n", "").find("includes itself"), std::string::npos)
        << "twice is none";
}

/// Each file includes the next one twice: 2^27 copies of the last.
TEST(Shader, IncludesThatMultiplyAreRefusedBeforeTheyTakeTheMemory) {
    ShaderIncludes doubling = {{"no_such_part.glsl", "#include \"f0\"\n"}}, nested = doubling, large = doubling;
    for (int i = 0; i < 27; ++i) {
        const std::string next = "#include \"f" + std::to_string(i + 1) + "\"\n";
        doubling["f" + std::to_string(i)] = next + next;
    }
    doubling["f27"] = "// the end\n";
    for (int i = 0; i < 200; ++i) nested["f" + std::to_string(i)] = "#include \"f" + std::to_string(i + 1) + "\"\n";
    large["f0"] = "#include \"big\"\n#include \"big\"\n#include \"big\"\n";
    large["big"] = std::string(7 << 20, '\n');
    const auto error = [](const ShaderIncludes& includes) {
        return error_message([&] { compile("missing_include.comp", "", "", includes); });
    };
    EXPECT_NE(error(doubling).find("more than 16 MiB or 2000 files"), std::string::npos) << error(doubling);
    EXPECT_NE(error(nested).find("f98:1 includes f99 within more than 100 other files"), std::string::npos)
        << error(nested);
    EXPECT_NE(error(large).find("f0:3 includes big"), std::string::npos) << error(large);
}

TEST(Shader, WebGl2RefusesWhatItDoesNotHave) {
    EXPECT_EQ(error_of("plain_webgl2.frag", ShaderLanguage::webgl2), "no error");
    EXPECT_EQ(error_of("image_store.frag"), "no error");
    EXPECT_NE(error_of("image_store.frag", ShaderLanguage::webgl2).find("image_store.frag:"), std::string::npos);
}

/// A member that the copy forgot would be undefined on lavapipe alone.
TEST(Shader, CopiesEveryMemberOfTheCamera) {
    const std::filesystem::path root = SSRLAB_SOURCE_DIR;
    const std::string copy = read_text(root / "core/shaders/copy_camera.glsl"),
                      declared = read_text(root / "core/shared/camera.h");
    const std::regex member("[ ,](\\w+)[,;]");
    const std::string block = declared.substr(declared.find("struct CameraData"));
    std::istringstream lines(block);
    unsigned members = 0;
    for (std::string line; std::getline(lines, line) && line.find("};") == std::string::npos;) {
        line = line.substr(0, line.find("//"));
        for (std::sregex_iterator i(line.begin(), line.end(), member), end; i != end; ++i, ++members) {
            const std::string name = (*i)[1];
            EXPECT_NE(copy.find("    camera." + name + " = camera_block.camera." + name + ";\n"), std::string::npos)
                << name;
        }
    }
    EXPECT_EQ(members, std::count(copy.begin(), copy.end(), ';'));
}

/// Constructs that Vulkan's GLSL has and GLSL ES 3.00 has not, and what stands for push constants.
TEST(Shader, WebGl2HasItsOwnLanguage) {
    const auto is_accepted = [](const char* text, ShaderLanguage language) {
        try {
            compile("empty.frag", "", shader_prelude({}, language) + text + "\n", {}, language);
        } catch (const Error&) {
            return false;
        }
        return true;
    };
    for (const char* text :
         {"float f() { return 1; }", "uint f(int i) { return uint(1) + i; }",
          "uniform sampler2D image; vec4 f() { return textureGather(image, vec2(0.5)); }",
          "uniform sampler2D image; int f() { return textureQueryLevels(image); }",
          "float f(float x) { return fma(x, x, x); }", "layout(early_fragment_tests) in;", "out vec4 a; out vec4 b;"}) {
        EXPECT_TRUE(is_accepted(text, ShaderLanguage::vulkan)) << text;
        EXPECT_FALSE(is_accepted(text, ShaderLanguage::webgl2)) << text;
    }
    for (const char* text :
         {"layout(push_constant) uniform Push { float a; uint b; vec4 c; };",
          "uniform usampler2D ids; uint f() { return texelFetch(ids, ivec2(0), 0).x; }",
          "layout(location = 0) out vec4 a; layout(location = 1) out float b;", "#include \"core/shaders/view.glsl\""})
        for (const ShaderLanguage language : {ShaderLanguage::vulkan, ShaderLanguage::webgl2})
            EXPECT_TRUE(is_accepted(text, language)) << text;
}

TEST(Shader, KnowsWhetherItIsAComputeShader) {
    const std::string only_compute = "#ifndef COMPUTE_SHADER\n#error no compute shader\n#endif\n";
    EXPECT_NO_THROW(compile("store_value.comp", "", only_compute));
    EXPECT_THROW(compile("empty.frag", "", only_compute), Error);
}

/// The formulas that the path tracer, the rasteriser and the techniques share compile in every language they are meant
/// for.
TEST(Shader, SharedHeadersCompileInBothLanguages) {
    size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(SSRLAB_SOURCE_DIR "/core/shared")) {
        const std::string name = file.path().filename();
        const std::string prelude = "#include \"core/shared/" + name + "\"\n";
        for (const ShaderLanguage language : {ShaderLanguage::vulkan, ShaderLanguage::webgl2})
            EXPECT_NO_THROW(compile("empty.frag", "", prelude, {}, language))
                << name << (language == ShaderLanguage::webgl2 ? " as GLSL ES 3.00" : " as GLSL 4.60");
        ++count;
    }
    EXPECT_GE(count, 4u);
}
