#pragma once
#include "experiments/gpu_costs/spirv/shader_flow.h"

/// A pipeline in which blocks of the shader can be found again in a chip's machine code: each marked block stores to a
/// place of its own in a buffer, which no compiler may leave out, move to another block or do twice in one.
struct MarkedShader {
    PipelineRecipe recipe;
    std::vector<unsigned> blocks;  ///< by their marks: places in ShaderFlow::blocks
    size_t shader_blocks = 0;      ///< of these, all
};

/// Where the store of a mark goes: byte offsets that the compiler writes into the instruction itself (12 bits).
inline constexpr unsigned first_mark_offset = 1024, mark_offset_limit = 4096;

/// Marked are those blocks that a compiler keeps: what is in them cannot be turned into a choice of values, since they
/// begin a loop, access memory or calculate more than it would do in vain (nir_opt_peephole_select takes 8 operations
/// in RADV, src/amd/vulkan/radv_pipeline.c of Mesa 22.3). Others are left as they are, so that the marked code has the
/// same branches. Fails with Error on a shader of more blocks than there are marks.
MarkedShader marked(const PipelineRecipe& simplified, const ShaderFlow& flow);
