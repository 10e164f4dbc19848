#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"
#include "experiments/gpu_costs/chips/compiled_shader.h"

#include <array>
#include <filesystem>
#include <functional>

// Compiles pipelines for a GPU that the machine does not have. If RADV_FORCE_FAMILY names a chip, Mesa's radv, the
// driver for AMD's GPUs, makes a device that only compiles. Each chip is compiled for in processes of its own
// (main.cpp).

/// A GPU by its name in radv.
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

/// All chips that the installed radv knows, among the chips of its versions up to Mesa 25. Takes some seconds. Fails
/// with MachineError if there is no radv.
std::vector<Chip> known_chips();

struct CompiledShader : CompilerNumbers {
    std::string stage;            ///< "compute", "vertex" or "fragment"
    std::optional<double> waves;  ///< "Subgroups per SIMD" as stated; occupancy_of() gives the waves of a SIMD
    std::string assembly;         ///< set if asked for
};

struct CompiledPipeline {
    std::vector<CompiledShader> shaders;
    std::string refusal;  ///< why there are none
};

struct ChipCompilation {
    /// Folder of earlier results, by recipe, chip and driver, in its folder `chips`; empty: none.
    std::filesystem::path cache;
    bool has_assembly = false;
    std::function<void(const std::string&)> notice;  ///< gets a sentence for the user
};

/// Compiles each recipe, in as many processes as there are cores. A pipeline that crashes or hangs the compiler has a
/// refusal; the others have results. Fails with MachineError if a process cannot be started.
std::vector<CompiledPipeline> compile_for_chip(const Chip& chip, const std::vector<PipelineRecipe>& recipes,
                                               const ChipCompilation& how);
