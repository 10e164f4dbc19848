#pragma once
#include "core/gpu/pipelines/pipeline_recipe.h"

#include <map>
#include <string>
#include <vector>

/// A number, vector or matrix in a block, or the first of an array of them.
struct BlockMember {
    std::string name;     ///< with the structures around it: "camera.extent"; "[]" stands behind an array
    std::string type;     ///< in GLSL: "vec4"
    unsigned offset = 0;  ///< bytes, from the block's begin; in an array of structures those of its first element
    unsigned stride = 0;  ///< bytes from one element of the innermost array to the next; 0: in no array
    bool is_read = false;
};

/// What a shader declares of one resource, and what it does with that.
struct ShaderResourceLayout {
    std::string type;  ///< in GLSL: "sampler2D"; "uniform" or "buffer" of a block
    bool is_read = false, is_written = false;
    std::vector<BlockMember> members;  ///< of a block
};

/// Resources of the last stage of a pipeline.
struct ShaderLayout {
    std::map<std::string, ShaderResourceLayout> resources;  ///< by the name of the variable or the block
    std::vector<BlockMember> push;                          ///< members of the push_constant block
};

/// Offsets and types are those in the SPIR-V. What constants switch off is not read or written. Fails with Error on a
/// shader that cannot be written as one function.
ShaderLayout layout_of(const PipelineRecipe& recipe);
