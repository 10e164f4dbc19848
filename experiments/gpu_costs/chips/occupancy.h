#pragma once
#include "experiments/gpu_costs/chips/chip_compiler.h"

/// What a SIMD shares among its waves. Registers are counted for waves of 64 lanes; a wave of 32 takes half the space.
struct SimdLimits {
    unsigned vgprs;      ///< of a lane, over all waves
    unsigned vgpr_step;  ///< registers are given out in such numbers
    unsigned sgprs;      ///< over all waves; 0: each wave has as many as it can name
    unsigned sgpr_step;
    unsigned waves;  ///< at most
    bool is_rdna;    ///< radv states the waves of RDNA in halves of 64 lanes: two for each wave of 64
};

/// Of the chip's generation; empty of a chip that is not listed here. Source: Mesa 22.3,
/// src/amd/vulkan/winsys/null/radv_null_winsys.c and src/amd/common/ac_gpu_info.c; AMD's instruction set manuals of GCN
/// 3, Vega, RDNA 2 and RDNA 3 have the sizes of the register files.
std::optional<SimdLimits> simd_limits(const std::string& chip);

/// How many waves of a shader a SIMD of the chip holds at a time, and why not more. Where shared memory limits it is an
/// upper bound: radv rounds up what a SIMD's part of it holds.
struct Occupancy {
    std::optional<unsigned> waves, most;  ///< of the `most` that it could hold; empty of a chip that is not known
    std::string limit;  ///< "nothing", "registers", "scalar registers", "shared memory"; "": not known
};
Occupancy occupancy_of(const std::string& chip, const CompiledShader& shader);
