#pragma once
#include "core/gpu/pipeline_recipe.h"

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

/// What the compiler states of one shader. What it does not state, or a newer Mesa under another name, is empty.
struct CompiledShader {
    std::string stage;                                                   ///< "compute", "vertex" or "fragment"
    unsigned lanes = 0;                                                  ///< of a wave: 32 or 64
    std::optional<uint64_t> vgprs, sgprs, spilled_vgprs, spilled_sgprs;  ///< registers of a lane and of a wave
    std::optional<uint64_t> scratch_bytes;                               ///< of a wave in memory, spills included
    std::optional<uint64_t> lds_bytes;                                   ///< of a workgroup
    std::optional<uint64_t> waves;  ///< "Subgroups per SIMD" as stated; occupancy_of() says what a SIMD holds
    std::optional<uint64_t> code_bytes, instructions, branches;
    /// The compiler's own estimate for a wave, in cycles: until it has ended, and how long it keeps the busiest unit.
    /// Loops are taken to run 8, then 4, then 2 times by their depth, divergent branches to be taken in 3 of 4 cases.
    std::optional<uint64_t> latency, inverse_throughput;
    std::string hash;      ///< of the machine code, as the driver states it
    std::string assembly;  ///< where it was asked for
};

struct CompiledPipeline {
    std::vector<CompiledShader> shaders;
    std::string refusal;  ///< why there are none
};

struct ChipCompilation {
    /// Folder of what is known already, by recipe, chip and driver, in its folder `chips`; empty: none.
    std::filesystem::path cache;
    bool has_assembly = false;                       ///< which is not cached
    std::function<void(const std::string&)> notice;  ///< gets a sentence for the user
};

/// One result for each recipe, in as many processes as there are cores. A pipeline that ends the compiler, or on
/// which it hangs, has a refusal, and the others their results. Fails with MachineError if a process cannot be started.
std::vector<CompiledPipeline> compile_for_chip(const Chip& chip, const std::vector<PipelineRecipe>& recipes,
                                               const ChipCompilation& how);
