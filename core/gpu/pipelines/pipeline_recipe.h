#pragma once
#include "core/gpu/pipelines/shader.h"

#include <optional>

/// How a fragment pass uses the stencil buffer: write a value, or draw only where it is found.
struct Stencil {
    enum class Mode { off, write, keep_equal } mode = Mode::off;
    unsigned value = 0;
    Image image;  ///< d32f_s8
};

/// How a fragment pass uses a depth buffer. `always` writes whatever is drawn.
struct DepthTest {
    enum class Compare { less, greater, less_or_equal, greater_or_equal, equal, always } compare = Compare::less;
    bool is_written = true;
    Image image;  ///< d32f, d24, d16 or d32f_s8
};

/// Values of specialization constants by their names in GLSL.
using Constants = std::map<std::string, uint32_t>;

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

/// All that a driver's compiler needs for one pipeline. It belongs to no device, so that a device that only compiles
/// can use it, too.
struct PipelineRecipe {
    std::vector<std::vector<unsigned>> spirv;  ///< compute: one module; else vertex and fragment
    bool is_compute = false;
    std::vector<ShaderInterface::Resource> resources;
    unsigned push_size = 0;                       ///< bytes of push constants
    std::array<unsigned, 3> local_size{1, 1, 1};  ///< of a workgroup
    std::map<uint32_t, uint32_t> constants;       ///< specialization constants by their ids
    PipelineState state;                          ///< of vertex and fragment
};

/// Recipes as bytes, for another program of the same build. Equal recipes have equal bytes.
std::string bytes_of(const std::vector<PipelineRecipe>& recipes);
/// Fails with Error if `bytes` are not those of bytes_of().
std::vector<PipelineRecipe> recipes_of(const std::string& bytes);
