// The library glsl_compiler.so (glsl_compiler.h).
#include "core/gpu/pipelines/glsl_compiler/glsl_compiler.h"
#include "core/gpu/pipelines/glsl_compiler/shader_rules.h"

#include <SPIRV/GlslangToSpv.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <SPIRV/spirv.hpp>
#include <spirv-tools/optimizer.hpp>

namespace {

/// glslang does not reflect specialization constants; each is decorated once in the SPIR-V: OpDecorate id SpecId
/// literal.
void find_constants(const std::vector<unsigned>& spirv, std::set<unsigned>& ids) {
    const size_t header = 5;
    for (size_t i = header; i < spirv.size(); i += spirv[i] >> 16)
        if ((spirv[i] & 0xffff) == spv::OpDecorate && spirv[i + 2] == spv::DecorationSpecId) ids.insert(spirv[i + 3]);
}

std::string type_name(const glslang::TType& type) {
    return std::string(type.getSampler().getString()) + (type.isArray() ? "[]" : "");
}

/// PassList binds one descriptor set, with one resource at each binding. A sentence about the first that does not fit.
std::string wrong_binding(const glslang::TProgram& program) {
    std::map<unsigned, std::string> known;
    std::string wrong;
    const auto check = [&](const glslang::TObjectReflection& r) {
        const glslang::TQualifier& qualifier = r.getType()->getQualifier();
        if (qualifier.isPushConstant() || !wrong.empty()) return;
        if (qualifier.hasSet() && qualifier.layoutSet != 0) {
            wrong = "'" + r.name +
                    "' has a descriptor set of its own; leave out its set = " + std::to_string(qualifier.layoutSet);
            return;
        }
        const auto [other, is_new] = known.try_emplace(unsigned(r.getBinding()), r.name);
        if (!is_new)
            wrong = "'" + other->second + "' and '" + r.name + "' have the same binding " +
                    std::to_string(r.getBinding()) + "; leave out their bindings, and each gets its own";
    };
    for (int i = 0; i < program.getNumUniformBlocks(); ++i) check(program.getUniformBlock(i));
    for (int i = 0; i < program.getNumBufferBlocks(); ++i) check(program.getBufferBlock(i));
    for (int i = 0; i < program.getNumUniformVariables(); ++i)
        if (const auto& u = program.getUniform(i); u.index < 0 && u.getType()->getBasicType() == glslang::EbtSampler)
            check(u);
    return wrong;
}

/// Adds the resources of one linked stage.
void reflect(const glslang::TProgram& program, bool is_vertex, ShaderInterface& found) {
    using Kind = ShaderInterface::Kind;
    for (int i = 0; i < program.getNumUniformBlocks(); ++i) {
        const auto& block = program.getUniformBlock(i);
        if (block.getType()->getQualifier().isPushConstant())
            found.push_size = unsigned(block.size);
        else
            found.resources.push_back({block.name, unsigned(block.getBinding()), Kind::uniforms, is_vertex});
    }
    for (int i = 0; i < program.getNumBufferBlocks(); ++i)
        found.resources.push_back({program.getBufferBlock(i).name, unsigned(program.getBufferBlock(i).getBinding()),
                                   Kind::storage, is_vertex});
    for (int i = 0; i < program.getNumUniformVariables(); ++i) {
        const auto& u = program.getUniform(i);
        if (u.index >= 0) {
            if (u.index < program.getNumUniformBlocks() &&
                program.getUniformBlock(u.index).getType()->getQualifier().isPushConstant()) {
                const std::string name = u.name.substr(u.name.rfind('.') + 1);
                found.push_offsets[name] = unsigned(u.offset);
                found.push_sizes[name] = 4 * unsigned(u.getType()->computeNumComponents());
            }
        } else if (u.getType()->getBasicType() == glslang::EbtSampler) {
            found.resources.push_back({u.name, unsigned(u.getBinding()),
                                       u.getType()->getSampler().isCombined() ? Kind::sampler : Kind::image, is_vertex,
                                       type_name(*u.getType())});
            if (u.getType()->getQualifier().hasFormat()) found.formatted_images.insert(u.name);
        }
    }
    if (is_vertex) return;
    for (int i = 0; i < program.getNumPipeOutputs(); ++i)
        if (const auto& output = program.getPipeOutput(i); !output.name.starts_with("gl_"))
            found.outputs[output.name] = output.getType()->getQualifier().layoutLocation;
    for (int d = 0; d < 3; ++d) found.local_size[size_t(d)] = program.getLocalSize(d);
}

EShLanguage glslang_stage(GlslStage stage) {
    return stage == GlslStage::vertex ? EShLangVertex : stage == GlslStage::fragment ? EShLangFragment : EShLangCompute;
}

void aim_at_vulkan(glslang::TShader& shader, bool is_vertex) {
    // Vulkan 1.3 would make glslang emit LocalSizeId, which needs maintenance4, absent from 1.2.
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
    for (const auto type : {glslang::EResSampler, glslang::EResTexture, glslang::EResImage, glslang::EResUbo,
                            glslang::EResSsbo, glslang::EResUav})
        shader.setShiftBinding(type, is_vertex ? first_vertex_binding : 0);
}

std::vector<unsigned> optimised_spirv(const glslang::TIntermediate& intermediate) {
    std::vector<unsigned> spirv;
    glslang::GlslangToSpv(intermediate, spirv);
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);  // serves one run only
    optimizer.RegisterPass(
        spvtools::CreateEliminateDeadConstantPass());  // those of the prelude that this shader ignores
    optimizer.Run(spirv.data(), spirv.size(), &spirv);
    return spirv;
}

}  // namespace

extern "C" CompileGlslStage compile_glsl_stage;

CompiledGlsl compile_glsl_stage(const GlslSource& source, ShaderInterface& interface) {
    using Failure = CompiledGlsl::Failure;
    static const bool initialised = glslang::InitializeProcess();
    (void)initialised;
    const bool is_webgl2 = source.language == ShaderLanguage::webgl2, is_vertex = source.stage == GlslStage::vertex;
    const EShLanguage stage = glslang_stage(source.stage);
    glslang::TShader shader(stage);
    glslang::TProgram program;
    const char* const text = source.text.c_str();
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, is_webgl2 ? glslang::EShClientOpenGL : glslang::EShClientVulkan,
                       100);
    if (!is_webgl2) aim_at_vulkan(shader, is_vertex);
    const auto rules = is_webgl2 ? EShMsgDefault : EShMessages(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), is_webgl2 ? 300 : 460, is_webgl2 ? EEsProfile : ECoreProfile, !is_webgl2,
                      false, rules))
        return {.failure = Failure::of_compiler, .why = shader.getInfoLog(), .spirv = {}, .foreign = {}};
    program.addShader(&shader);
    if (!program.link(rules) || (!is_webgl2 && !program.mapIO()))
        return {.failure = Failure::of_linker, .why = program.getInfoLog(), .spirv = {}, .foreign = {}};
    if (is_webgl2) return {};
    program.buildReflection(EShReflectionAllBlockVariables | EShReflectionIntermediateIO |
                            EShReflectionSeparateBuffers);
    if (const std::string wrong = wrong_binding(program); !wrong.empty())
        return {.failure = Failure::of_bindings, .why = wrong, .spirv = {}, .foreign = {}};
    reflect(program, is_vertex, interface);
    CompiledGlsl compiled;
    compiled.spirv = optimised_spirv(*program.getIntermediate(stage));
    compiled.foreign = foreign_capabilities(compiled.spirv);
    find_constants(compiled.spirv, interface.constants);
    return compiled;
}
