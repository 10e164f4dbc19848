#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"

/// The inputs that a shader reads.
struct ShaderReads {
    std::set<std::string> samplers;  ///< names of variables
    std::set<unsigned> params;       ///< indices of members of the block `Params`
};

/// Inputs of the last stage of a pipeline with constants in place: what they switch off is not read. Fails with Error
/// on a shader that cannot be written as one function.
ShaderReads reads_of(const PipelineRecipe& recipe);
