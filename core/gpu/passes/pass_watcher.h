#pragma once
#include "core/gpu/passes/pass_list.h"

#include <span>

/// One run of a pass, with all that another API needs to run it again. What it points to lives until the watcher
/// returns.
struct PassRun {
    struct BoundImage {
        std::string name;  ///< of the variable in the shader
        Image image;
        Sampling sampling;
    };
    std::string stage, shader;  ///< label, and file of the compute or fragment shader
    bool draws_meshes = false;
    const ParameterSet& params;  ///< of its prelude and of its block `Params`
    const ShaderIncludes& includes;
    const Constants& constants;          ///< of PassList::set_constants()
    PipelineRecipe recipe;               ///< in the form for GPUs
    std::vector<BoundImage> samplers;    ///< all that its shader declares; for meshes, of the first one
    std::vector<BoundImage> images;      ///< storage images, the same
    std::vector<Buffer> buffers;         ///< the same
    std::vector<Image> targets;          ///< by location; each one mip
    glm::uvec2 area{0};                  ///< pixels of a fragment pass or of drawn meshes
    std::function<glm::uvec3()> groups;  ///< of a compute pass; waits for the device if a buffer holds them
    DepthTest depth;                     ///< without an image: no test
    Stencil stencil;
    std::vector<std::byte> push;  ///< content of its push_constant block
    /// Invocations of a compute pass that ran for the watcher, if the device counts them.
    std::optional<uint64_t> device_invocations;
};

/// A pipeline that replaces a pass's own and has one storage buffer more.
struct InstrumentedPipeline {
    PipelineRecipe recipe;         ///< names the buffer among its resources
    std::string buffer;            ///< block name in the shader
    size_t bytes = 0;              ///< of the buffer
    std::vector<std::byte> begin;  ///< first bytes when the pass starts; zeros follow
};

/// Is told of all that changes the images of a pass_list, in order; of clears and uploads afterwards. Watched passes
/// give the same bits, but take other times.
class PassWatcher {
public:
    virtual ~PassWatcher() = default;
    virtual void begin_frame() {}
    /// The change that the watcher wants in each compute or fragment shader; null: none.
    virtual const GlslChange* glsl_change() const { return nullptr; }
    /// Called before a pass runs. If it returns no pipeline, the pass runs unchanged and after() is not called.
    virtual std::optional<InstrumentedPipeline> before(const PassRun&) { return {}; }
    /// `content`: what the pass left in the buffer; it lives until the watcher returns.
    virtual void after(const PassRun&, std::span<const std::byte> /*content*/) {}
    virtual void cleared(const Image&, glm::vec4 /*value*/) {}
    virtual void cleared(const Buffer&) {}
    virtual void uploaded(const Image&) {}
};
