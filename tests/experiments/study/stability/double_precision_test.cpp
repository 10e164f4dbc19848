#include "core/error.h"
#include "experiments/study/stability/precision/double_shader.h"
#include "tests/variants/technique_fixture.h"
#include "variants/denoisers/denoisers.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

namespace {

const std::filesystem::path techniques = std::filesystem::path(SSRLAB_SOURCE_DIR) / "variants";

std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

const auto in_double_everywhere = double_where([](const std::string&) { return true; });

/// The converted text with its doubles called floats again, and without what converting adds.
std::string narrowed(std::string text) {
    const std::pair<const char*, const char*> changes[] = {{R"(\bdouble\b)", "float"},
                                                           {R"(\bd((vec|mat)[234](x[234])?)\b)", "$1"},
                                                           {R"((\d|\.)LF\b)", "$1"},
                                                           {R"(\bwide_(\w+)\b)", "$1"},
                                                           {R"(= vec4\( (vec4\([^;]*\))\);)", "= $1;"}};
    for (const auto& [from, to] : changes) text = std::regex_replace(text, std::regex(from), to);
    return text.substr(0, text.rfind("\nvoid main() {\n    main();\n"));
}

}  // namespace

/// What is compared as "the same algorithm in double" is the shader's own text, but for its types.
TEST(DoublePrecision, OfEveryShaderOnlyTypesChange) {
    size_t shaders = 0, with_doubles = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(techniques)) {
        const std::string kind = entry.path().extension().string();
        if (kind != ".glsl" && kind != ".comp" && kind != ".frag") continue;
        const std::string text = contents(entry.path()), wide = in_double(text, "");
        // Structs of buffers, of which these files are: kept as they are, and a constructor added.
        if (std::regex_search(text, std::regex("struct (RayRecord|ExactHit) "))) continue;
        // Outputs are declared once more in front.
        const std::string body = narrowed(wide.substr(wide.find("#line 1 0\n") + 10));
        EXPECT_EQ(body, text) << entry.path();
        ++shaders, with_doubles += std::regex_search(wide, std::regex("\\b(double|dvec[234])\\b"));
    }
    EXPECT_GT(shaders, 90u);
    EXPECT_GT(with_doubles, 80u);
}

/// So that `ssrlab stability --precision` can say something of every stage of every technique.
TEST(DoublePrecision, EveryShaderCompiles) {
    size_t count = 0;
    const auto compile_all = [&](const std::string& folder, const ParameterSet& params,
                                 const ShaderIncludes& includes) {
        for (const auto& file : std::filesystem::directory_iterator(techniques / folder)) {
            if (file.path().extension() != ".comp" && file.path().extension() != ".frag") continue;
            const std::string name = folder + "/" + file.path().filename().string();
            EXPECT_NO_THROW(compile(name, "", shader_prelude(params), includes, ShaderLanguage::vulkan,
                                    {.glsl = {*in_double_everywhere("")}}))
                << name;
            ++count;
        }
    };
    for (const TechniqueEntry& entry : technique_table()) {
        if (!entry.is_ssrlabs()) continue;  // of another test of this process
        const std::unique_ptr<Technique> technique = make_technique(entry.name, {}, "");
        compile_all(entry.name, technique->params, technique->shader_includes());
    }
    compile_all("denoisers", make_technique("composed_ssr")->params, {});  // what reads rays
    for (const DenoiserEntry& entry : denoiser_table())
        compile_all("denoisers/" + entry.name, Denoiser(entry).params, {});
    EXPECT_GT(count, 50u);
}
