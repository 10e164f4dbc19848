#include "core/gpu/shader.h"

#include "core/error.h"

#include <SPIRV/GlslangToSpv.h>
#include <SPIRV/spirv.hpp>
#include <fstream>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <memory>
#include <sstream>
#include <spirv-tools/optimizer.hpp>

namespace {

using Roots = std::vector<std::filesystem::path>;

std::string read_text(const std::filesystem::path& name, const Roots& roots) {
    for (const auto& root : roots)
        if (std::ifstream in(root / name); in) return {std::istreambuf_iterator<char>(in), {}};
    fail("no shader file ", name, " under ", roots.size(), " shader folders");
}

/// Replaces #include "x" by the text of x. The headers guard themselves against double inclusion.
std::string expand_includes(const std::string& text, const Roots& roots) {
    std::istringstream in(text);
    std::ostringstream out;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("#include \""))
            out << expand_includes(read_text(line.substr(10, line.rfind('"') - 10), roots), roots);
        else
            out << line << '\n';
    }
    return out.str();
}

/// glslang does not reflect specialization constants; each is decorated once in the SPIR-V: OpDecorate id SpecId literal.
void find_constants(const std::vector<unsigned>& spirv, std::set<unsigned>& ids) {
    const size_t header = 5;
    for (size_t i = header; i < spirv.size(); i += spirv[i] >> 16)
        if ((spirv[i] & 0xffff) == spv::OpDecorate && spirv[i + 2] == spv::DecorationSpecId) ids.insert(spirv[i + 3]);
}

const char* const fullscreen_triangle = "void main() { gl_Position = vec4(vec2(gl_VertexIndex << 1 & 2, gl_VertexIndex & 2) * 2.0 - 1.0, 0.0, 1.0); }";

}  // namespace

Shader compile(const std::filesystem::path& file, const std::string& prelude, const Roots& roots, ShaderLanguage language) {
    static const bool initialised = glslang::InitializeProcess();
    (void)initialised;
    const bool webgl2 = language == ShaderLanguage::webgl2, is_compute = file.extension() == ".comp";

    std::vector<std::pair<EShLanguage, std::string>> sources;
    if (!is_compute && !webgl2) sources.emplace_back(EShLangVertex, fullscreen_triangle);
    sources.emplace_back(is_compute ? EShLangCompute : EShLangFragment, expand_includes(prelude + read_text(file, roots), roots));

    std::vector<std::unique_ptr<glslang::TShader>> shaders;  // outlive the program
    glslang::TProgram program;
    const auto rules = webgl2 ? EShMsgDefault : EShMessages(EShMsgSpvRules | EShMsgVulkanRules);
    for (const auto& [stage, text] : sources) {
        auto& shader = *shaders.emplace_back(std::make_unique<glslang::TShader>(stage));
        const char* const lines = text.c_str();
        shader.setStrings(&lines, 1);
        shader.setEnvInput(glslang::EShSourceGlsl, stage, webgl2 ? glslang::EShClientOpenGL : glslang::EShClientVulkan, 100);
        if (webgl2) {
            shader.setPreamble("precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n");
        } else {
            shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
            shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
            shader.setAutoMapBindings(true);
            shader.setAutoMapLocations(true);
        }
        if (!shader.parse(GetDefaultResources(), webgl2 ? 300 : 460, webgl2 ? EEsProfile : ECoreProfile, true, false, rules))
            fail(file, ":\n", shader.getInfoLog());
        program.addShader(&shader);
    }
    if (webgl2) return {};
    if (!program.link(rules) || !program.mapIO()) fail(file, ":\n", program.getInfoLog());
    program.buildReflection(EShReflectionAllBlockVariables | EShReflectionIntermediateIO);

    Shader result;
    auto& found = result.interface;
    using Kind = ShaderInterface::Kind;
    for (int i = 0; i < program.getNumUniformVariables(); ++i) {
        const auto& u = program.getUniform(i);
        if (u.index >= 0)
            found.offsets[u.name] = unsigned(u.offset);
        else
            found.resources[u.name] = {unsigned(u.getBinding()), u.getType()->getSampler().isCombined() ? Kind::sampler : Kind::image};
    }
    for (int i = 0; i < program.getNumUniformBlocks(); ++i)
        found.resources[program.getUniformBlock(i).name] = {unsigned(program.getUniformBlock(i).getBinding()), Kind::uniforms};
    for (int i = 0; i < program.getNumPipeOutputs(); ++i)
        found.outputs[program.getPipeOutput(i).name] = program.getPipeOutput(i).getType()->getQualifier().layoutLocation;
    for (int d = 0; d < 3; ++d) found.local_size[d] = program.getLocalSize(d);
    for (const auto& [stage, text] : sources) {
        auto& spirv = result.spirv.emplace_back();
        glslang::GlslangToSpv(*program.getIntermediate(stage), spirv);
        spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);  // serves one run only
        optimizer.RegisterPass(spvtools::CreateEliminateDeadConstantPass());  // those of the prelude which this shader ignores
        optimizer.Run(spirv.data(), spirv.size(), &spirv);
        find_constants(result.spirv.back(), found.constants);
    }
    return result;
}
