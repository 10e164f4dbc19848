#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"

/// What a shader looks at.
struct ShaderReads {
    std::set<std::string> samplers;  ///< names of variables
    std::set<unsigned> params;       ///< places among the members of the block `Params`
};

/// Of the last stage of a pipeline with the values of its constants in place: what they switch off is not looked at.
/// Fails with Error on a shader that cannot be written as one function.
ShaderReads reads_of(const PipelineRecipe& recipe);
