#pragma once
#include "experiments/gpu_costs/chips/chip_compiler.h"

/// Resources that a SIMD shares among its waves. Registers are counted for waves of 64 lanes; a wave of 32 lanes takes
/// half the space.
struct SimdLimits {
    unsigned vgprs;      ///< registers of a lane, over all waves
    unsigned vgpr_step;  ///< allocation unit of registers
    unsigned sgprs;      ///< over all waves; 0: each wave has the most that instructions can name
    unsigned sgpr_step;
    unsigned waves;  ///< at most
    bool is_rdna;    ///< radv counts the waves of RDNA in halves: two for each wave of 64 lanes
    /// As `vgprs`, where radv's device without hardware states waves of fewer registers than the chip has; else 0.
    unsigned stated_vgprs = 0;
};

/// Limits of the chip's generation; nullopt for a chip that is not listed. Source: Mesa,
/// src/amd/vulkan/winsys/null/radv_null_winsys.c and src/amd/common/ac_gpu_info.c; sizes of register files: AMD's
/// instruction set manuals of GCN 3, Vega, RDNA 2 and RDNA 3. For gfx1151 and RDNA 4 the first of these files has 512
/// registers in Mesa 25.0.7, the second 768.
std::optional<SimdLimits> simd_limits(const std::string& chip);

/// How many waves of a shader a SIMD holds at a time, and what limits them. If shared memory is the limit, the number
/// is an upper bound: radv rounds up a SIMD's share.
struct Occupancy {
    std::optional<unsigned> waves, most;  ///< waves held, and most that a SIMD can hold; empty for an unknown chip
    std::string limit;                    ///< "nothing", "registers", "scalar registers", "shared memory"; "": unknown
};
Occupancy occupancy_of(const std::string& chip, const CompiledShader& shader);
