#pragma once
#include "core/gpu/pass_graph.h"
#include "core/gpu/pipelines/pipeline_recipe.h"

/// A fragment pass over whole images, with all that another API needs to run it again. What it points to lives until
/// the recorder returns.
struct RecordedPass {
    struct Texture {
        std::string name;  ///< of the sampler in the shader
        Image image;
        Sampling sampling;
    };
    std::string stage, shader;   ///< label, and file of the fragment shader
    const ParameterSet& params;  ///< of its prelude and of its block `Params`
    const ShaderIncludes& includes;
    const PipelineRecipe& recipe;   ///< in the form for GPUs
    std::vector<Texture> textures;  ///< all that its shader declares
    std::vector<Image> targets;     ///< by location; each one mip
    DepthTest depth;                ///< without an image: no test
    Stencil stencil;
    std::vector<std::byte> push;  ///< content of its push_constant block
};

/// Hears of all that changes the images of a graph, in its order: of clears and uploads after they were done.
struct GraphRecorder {
    std::function<void(const RecordedPass& pass)> pass;
    std::function<void(const Image& image, glm::vec4 value)> clear;
    std::function<void(const Image& image)> upload;
};

/// The whole of what an image is a mip of.
struct WholeImage {
    glm::uvec2 extent;
    unsigned mips;
};
WholeImage whole_of(const Image& image);

/// What a shader looks at.
struct ShaderReads {
    std::set<std::string> samplers;  ///< names of variables
    std::set<unsigned> params;       ///< places among the members of the block `Params`
};

/// Of the last stage of a pipeline with the values of its constants in place: what they switch off is not looked at.
/// Fails with Error on a shader that cannot be written as one function.
ShaderReads reads_of(const PipelineRecipe& recipe);
