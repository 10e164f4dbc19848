#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"
#include "experiments/gpu_costs/spirv/flow_graph.h"

// A shader as one function without constants that a pipeline decides: what is counted of its blocks where it runs, and
// what a chip's compiler makes of them, are found again by the same labels.

/// The flow of control of a compute or fragment shader that simplified() gave.
struct ShaderFlow {
    struct Block {
        unsigned label = 0;                ///< its id in the module
        std::vector<unsigned> successors;  ///< places in `blocks`; of a branch: where true, where false
        /// Of a trace: a branch takes one bit, a switch one for each of its cases, in order, in front of its default.
        unsigned decisions = 0;
        /// In the order in which a wave runs blocks: those of a construct before those behind it, so that lanes that
        /// leave it early wait there.
        unsigned rank = 0;
        unsigned operations = 0;  ///< scalar arithmetic, as the module states it
        unsigned fetches = 0;     ///< instructions that read images
        bool has_memory = false;  ///< it reads or writes images, buffers or the workgroup's memory
        bool is_loop_header = false;
    };
    std::vector<Block> blocks;  ///< the first is where the shader starts
};

/// The pipeline with its constants in place, and its last stage as one function, in which each call has blocks of its
/// own. It computes the same. Fails with Error on a shader that cannot be written so.
PipelineRecipe simplified(const PipelineRecipe& recipe);

/// Of the last stage of a simplified pipeline.
ShaderFlow flow_of(const PipelineRecipe& simplified);

FlowGraph graph_of(const ShaderFlow& flow);

/// Gives the last stage a storage buffer of that name more; its binding.
unsigned add_storage_buffer(PipelineRecipe& recipe, const std::string& name);
