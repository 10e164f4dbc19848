#pragma once
#include "experiments/gpu_costs/spirv/shader_flow.h"

/// A pipeline whose shader's blocks can be found again in a chip's machine code. Each marked block stores to its own
/// place in a buffer; no compiler may leave the store out, move it to another block or do it twice.
struct MarkedShader {
    PipelineRecipe recipe;
    std::vector<unsigned> blocks;  ///< by mark: index into ShaderFlow::blocks
    size_t shader_blocks = 0;      ///< number of all blocks
};

/// Byte offsets of the marks' stores, which the compiler writes into the instruction itself (12 bits).
inline constexpr unsigned first_mark_offset = 1024, mark_offset_limit = 4096;

/// Marks the blocks that a compiler keeps: they begin a loop, access memory, or calculate too much to be replaced by a
/// choice of values (nir_opt_peephole_select accepts 8 operations in RADV, src/amd/vulkan/radv_pipeline.c of Mesa
/// 22.3). Other blocks stay unmarked, so that the code has the same branches. Fails with Error on a shader with more
/// blocks than marks.
MarkedShader marked(const PipelineRecipe& simplified, const ShaderFlow& flow);
