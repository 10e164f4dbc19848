#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"
#include "experiments/gpu_costs/chips/compiled_shader.h"

#include <array>
#include <filesystem>
#include <functional>

// What a GPU's compiler makes of a pipeline, without the GPU: Mesa's radv, which compiles for AMD's, makes a device
// that only compiles where RADV_FORCE_FAMILY names a chip. Each chip is asked in processes of its own (main.cpp).

/// A GPU by the name that radv has for it.
struct Chip {
    std::string name;    ///< "navi21"
    std::string device;  ///< "Null hardware (RADV NAVI21)"
    std::string driver;  ///< "radv Mesa 22.3.6"
};

/// RDNA 2, RDNA 3 and GCN 5.
inline constexpr std::array default_chips = {"navi21", "gfx1100", "vega10"};

/// `name`: in any case. Fails with Error if the installed radv does not know it, with MachineError where there is no
/// radv.
Chip find_chip(const std::string& name);

/// All chips that the installed radv knows, of those that any of its versions up to Mesa 25 does; some seconds. Fails
/// with MachineError where there is no radv.
std::vector<Chip> known_chips();

struct CompiledShader : CompilerNumbers {
    std::string stage;            ///< "compute", "vertex" or "fragment"
    std::optional<double> waves;  ///< "Subgroups per SIMD" as stated; occupancy_of() says what a SIMD holds
    std::string assembly;         ///< where it was asked for
};

struct CompiledPipeline {
    std::vector<CompiledShader> shaders;
    std::string refusal;  ///< why there are none
};

struct ChipCompilation {
    /// Folder of what is known already, by recipe, chip and driver, in its folder `chips`; empty: none.
    std::filesystem::path cache;
    bool has_assembly = false;
    std::function<void(const std::string&)> notice;  ///< gets a sentence for the user
};

/// One result for each recipe, in as many processes as there are cores. A pipeline that ends the compiler, or on
/// which it hangs, has a refusal, and the others their results. Fails with MachineError if a process cannot be started.
std::vector<CompiledPipeline> compile_for_chip(const Chip& chip, const std::vector<PipelineRecipe>& recipes,
                                               const ChipCompilation& how);
