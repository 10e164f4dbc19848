#pragma once
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/gpu_costs/chips/machine_code.h"

/// The work of a chip's code for a shader, by the shader's blocks.
struct ShaderWork {
    struct Block {
        ChipWork work;       ///< of a wave, for each run
        ChipWork uncertain;  ///< part of `work` whose number of runs is an upper bound
    };
    std::vector<Block> blocks;  ///< same indices as ShaderFlow::blocks
    unsigned lanes = 64;        ///< of a wave
    double resident_waves = 1;  ///< waves that a SIMD holds at a time; 1 if the chip's registers are unknown
};

/// The work of a shader from three compilations: the pass's own (`original`), simplified, and simplified with marks;
/// the latter two have assembly. Code of the simplified shader has up to a fifth more instructions than the original's.
/// Arithmetic and latency are therefore scaled by the ratio of both codes' instructions, and registers are the
/// original's. Fails with Error on assembly that cannot be parsed.
ShaderWork shader_work(const MarkedShader& marks, const CompiledShader& original, const CompiledShader& simplified,
                       const CompiledShader& marked, const std::string& chip, const ChipRates& rates);
