#pragma once
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/gpu_costs/chips/machine_code.h"

/// What a chip's code for a shader asks of it, by the blocks of the shader.
struct ShaderWork {
    struct Block {
        ChipWork work;       ///< of a wave for each run
        ChipWork uncertain;  ///< the part of it of which runs are known at most
    };
    std::vector<Block> blocks;  ///< as ShaderFlow::blocks
    unsigned lanes = 64;        ///< of a wave
    double resident_waves = 1;  ///< that a SIMD holds at a time; 1 of a chip whose registers are not known
};

/// Of the shader as the pass has it (`original`), simplified, and that with marks; the latter two with their assembly.
/// What the compiler makes of the simplified shader has up to a fifth more instructions than what it makes of the
/// original: arithmetic and latency are scaled by what it states of both, and registers are the original's. Fails with
/// Error on assembly that cannot be read.
ShaderWork shader_work(const MarkedShader& marks, const CompiledShader& original, const CompiledShader& simplified,
                       const CompiledShader& marked, const std::string& chip, const ChipRates& rates);
