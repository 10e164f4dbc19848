#pragma once
#include "core/gpu/chips/chip_compiler.h"

/// What a SIMD shares among its waves. Registers are counted for waves of 64 lanes; a wave of 32 takes half the space.
struct SimdLimits {
    unsigned vgprs;      ///< of a lane, over all waves
    unsigned vgpr_step;  ///< registers are given out in such numbers
    unsigned sgprs;      ///< over all waves; 0: each wave has as many as it can name
    unsigned sgpr_step;
    unsigned waves;   ///< at most
    unsigned stated;  ///< radv states so many for each wave: on RDNA two
};

/// Of the chip's generation; empty of a chip that none of ours is. Source: Mesa 22.3, src/amd/common/ac_gpu_info.c,
/// which agrees with AMD's manuals of GCN 3, Vega, RDNA 2 and RDNA 3 (chapter on the sizes of register files).
std::optional<SimdLimits> simd_limits(const std::string& chip);

/// How many waves of a shader a SIMD of the chip holds at a time, and why not more.
struct Occupancy {
    std::optional<unsigned> waves, most;  ///< of the `most` that it could hold; empty of a chip that is not known
    std::string limit;  ///< "nothing", "registers", "scalar registers", "shared memory"; "": not known
};
Occupancy occupancy_of(const std::string& chip, const CompiledShader& shader);
