#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"
#include "experiments/gpu_costs/spirv/flow_graph.h"

// A shader as one function with constants in place. Counts of its blocks at run time and the code of a chip's compiler
// are matched by the same labels.

/// The control flow of a simplified() compute or fragment shader.
struct ShaderFlow {
    struct Block {
        unsigned label = 0;                ///< its id in the module
        std::vector<unsigned> successors;  ///< indices into `blocks`; for a branch: true, then false
        /// Bits in a trace: one for a branch; for a switch one for each case, in order, before its default.
        unsigned decisions = 0;
        /// Order in which a wave runs blocks: those of a construct before those after it, so that lanes that leave
        /// early wait.
        unsigned rank = 0;
        unsigned operations = 0;  ///< scalar arithmetic, as the module states it
        unsigned fetches = 0;     ///< instructions that read images
        bool has_memory = false;  ///< reads or writes images, buffers or the workgroup's memory
        bool is_loop_header = false;
    };
    std::vector<Block> blocks;  ///< the first is the start
};

/// The pipeline with constants in place, and its last stage as one function in which each call has its own blocks. It
/// computes the same result. Fails with Error on a shader that cannot be written so.
PipelineRecipe simplified(const PipelineRecipe& recipe);

/// The flow of the last stage of a simplified pipeline.
ShaderFlow flow_of(const PipelineRecipe& simplified);

FlowGraph graph_of(const ShaderFlow& flow);

/// Adds a storage buffer of this name to the last stage; returns its binding.
unsigned add_storage_buffer(PipelineRecipe& recipe, const std::string& name);
