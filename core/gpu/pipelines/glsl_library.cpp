#include "core/error.h"
#include "core/gpu/pipelines/glsl_compiler/glsl_compiler.h"
#include "core/memory_fault.h"
#include "core/own_files.h"

#include <dlfcn.h>

namespace {

constexpr size_t library_bytes = 32 << 20;  // at most, with its tables

/// Stays loaded until the process ends.
CompileGlslStage* load_compiler() {
    const std::string file = (built_files() / "glsl_compiler.so").string();
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const function = library ? dlsym(library, "compile_glsl_stage") : nullptr;
    if (!function && !can_get_memory(library_bytes)) fail_machine(memory_sentence(" for the compiler of shaders"));
    if (!function) fail_machine("ssrlab's compiler of shaders cannot be loaded: ", dlerror());
    return reinterpret_cast<CompileGlslStage*>(function);
}

}  // namespace

CompiledGlsl compile_glsl(const GlslSource& source, ShaderInterface& interface) {
    static CompileGlslStage* const compile_stage = load_compiler();
    return compile_stage(source, interface);
}
