#pragma once
#include "core/gpu/pipelines/glsl_compiler/shader_interface.h"

#include <string>
#include <vector>

// glslang and SPIRV-Tools, behind one function of a library that is loaded with the first shader: glslang's tables take
// 25 ms and 7 MB before `main`, and most commands compile no shader.

enum class GlslStage { vertex, fragment, compute };

/// One stage of a shader, without #include.
struct GlslSource {
    GlslStage stage;
    ShaderLanguage language;  ///< webgl2: the text is only checked
    std::string text;
};

struct CompiledGlsl {
    enum class Failure { none, of_compiler, of_linker, of_bindings } failure = Failure::none;
    std::string why;              ///< of a failure: glslang's log, of bindings a sentence that begins with a resource
    std::vector<unsigned> spirv;  ///< empty for webgl2
    std::vector<std::string> foreign;  ///< foreign_capabilities() of the SPIR-V (shader_rules.h)
};

/// Compiles for Vulkan 1.2 and adds the stage's resources to `interface`, or checks by the rules of GLSL ES 3.00. Fails
/// with MachineError if the library cannot be loaded.
CompiledGlsl compile_glsl(const GlslSource& source, ShaderInterface& interface);

/// What the library exports as "compile_glsl_stage".
using CompileGlslStage = CompiledGlsl(const GlslSource&, ShaderInterface&);
