#pragma once
#include "core/gpu/pass_graph.h"
#include "core/gpu/pipelines/shader.h"

#include <optional>

/// What a pipeline is made for, apart from its shader.
struct PipelineState {
    struct Depth {
        DepthTest::Compare compare = DepthTest::Compare::less;
        bool is_written = true;
        Format format{};
    };

    std::vector<Format> attachments;  ///< by location
    Stencil::Mode stencil = Stencil::Mode::off;
    unsigned stencil_value = 0;
    std::optional<Depth> depth;
};

/// All that a driver's compiler is given for one pipeline. It belongs to no device: the one that renders makes it, and
/// so can one that only compiles.
struct PipelineRecipe {
    std::vector<std::vector<unsigned>> spirv;  ///< compute: one module; else vertex and fragment
    bool is_compute = false;
    std::vector<ShaderInterface::Resource> resources;
    unsigned push_size = 0;                       ///< bytes of push constants
    std::array<unsigned, 3> local_size{1, 1, 1};  ///< of a workgroup
    std::map<uint32_t, uint32_t> constants;       ///< specialization constants by their ids
    PipelineState state;                          ///< of vertex and fragment
};

/// For a file between two programs of one build: equal recipes have equal bytes.
std::string bytes_of(const std::vector<PipelineRecipe>& recipes);
/// Fails with Error if `bytes` are not those of bytes_of().
std::vector<PipelineRecipe> recipes_of(const std::string& bytes);
