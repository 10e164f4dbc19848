#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"
#include "experiments/gpu_costs/chips/compiled_shader.h"
#include "experiments/gpu_costs/chips/unpacked_mesa.h"

#include <array>
#include <filesystem>
#include <functional>

// Compiles pipelines for a GPU that the machine does not have. If RADV_FORCE_FAMILY names a chip, Mesa's radv, the
// driver for AMD's GPUs, makes a device that only compiles. Each chip is compiled for in processes of its own
// (main.cpp).

/// A GPU by its name in radv.
struct Chip {
    std::string name;            ///< "gfx1100", as it was asked for
    std::string name_in_driver;  ///< "navi31": what this version of radv calls it
    std::string device;          ///< "Null hardware (RADV NAVI31)"
    std::string driver;          ///< "radv Mesa 25.0.7"
    std::filesystem::path radv;  ///< the driver's file; "": the installed driver
};

/// RDNA 2, RDNA 3 and GCN 5.
inline constexpr std::array default_chips = {"navi21", "gfx1100", "vega10"};

/// `name`: in any case; a chip that Mesa renamed has both names. `mesa`: a folder, see unpacked_mesa.h; "": the
/// installed one. Fails with Error if radv does not know the chip or `mesa` has no radv that can be used, with
/// MachineError where none is installed.
Chip find_chip(const std::string& name, const std::filesystem::path& mesa = chosen_mesa());

/// All chips that radv knows, among the chips of its versions from Mesa 22.3 to 25.0. Takes some seconds. Fails as
/// find_chip() does.
std::vector<Chip> known_chips(const std::filesystem::path& mesa = chosen_mesa());

/// The other name of a chip that Mesa renamed after 22.3 ("gfx1100" and "navi31"); "" for all others.
std::string other_name(const std::string& chip);

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
