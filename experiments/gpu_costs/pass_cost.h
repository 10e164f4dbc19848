#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/counted_shader.h"

#include <array>

/// What one stage of a frame did, counted by its shaders themselves: the same on every device and in every run, as far
/// as the stage's results are.
///
/// Bytes are those that instructions ask for, in the format of the image or buffer: there are no caches, no compression
/// of images and no padding of texels in this count. Not counted: vertex shaders and what they read, indices, the tests
/// of depth and stencil and their writes, uniform blocks, push constants, sizes of images, uploads.
struct PassCost {
    std::string stage;
    uint64_t invocations = 0;    ///< of compute and fragment shaders: all that are started; no helpers of derivatives
    uint64_t idle = 0;           ///< those of them that wrote nothing: beyond the edge, without work, discarded
    uint64_t fetches = 0;        ///< instructions that read images
    uint64_t texels = 0;         ///< of those: 1 each, 4 of a gather or a linear filter, 8 of one of an image with mips
    uint64_t bytes_read = 0;     ///< from images and buffers
    uint64_t bytes_written = 0;  ///< to images, buffers and colour targets; by a clear: the size of what it clears
    /// Of each image and buffer that a pass reads, the lesser of its size and what was read of it, and the same of what
    /// it writes: the traffic with memory if a cache forgot nothing during a pass.
    uint64_t unique_bytes = 0;
    uint64_t shared_bytes = 0;  ///< of the workgroup's memory, read and written
    uint64_t atomics = 0;       ///< their 4 bytes are both read and written
    uint64_t operations = 0;    ///< scalar arithmetic as the shader states it, see count_in() in counted_shader.h

    void add(const PassCost& other);  ///< its counts; `stage` stays
};

struct CostQuantity {
    const char* name;
    uint64_t PassCost::*member;
};

inline constexpr std::array cost_quantities = {
    CostQuantity{"invocations", &PassCost::invocations},   CostQuantity{"idle", &PassCost::idle},
    CostQuantity{"fetches", &PassCost::fetches},           CostQuantity{"texels", &PassCost::texels},
    CostQuantity{"bytes_read", &PassCost::bytes_read},     CostQuantity{"bytes_written", &PassCost::bytes_written},
    CostQuantity{"unique_bytes", &PassCost::unique_bytes}, CostQuantity{"shared_bytes", &PassCost::shared_bytes},
    CostQuantity{"atomics", &PassCost::atomics},           CostQuantity{"operations", &PassCost::operations},
};

/// Lets the passes of a pass_list count what they do. Costs the compilation of a second pipeline for each shader.
class CostCounter : public PassWatcher {
public:
    /// Of the stages since the frame began or the pass_list was watched, in order; those of a stage that ran several
    /// times are added.
    const std::vector<PassCost>& costs() const { return costs_; }

    void begin_frame() override { costs_.clear(); }
    const GlslChange* glsl_change() const override { return &change_; }
    std::optional<InstrumentedPipeline> before(const PassRun& run) override;
    /// Fails with Error if the device counts invocations itself, and others than the shader.
    void after(const PassRun& run, std::vector<std::byte> content) override;
    void cleared(const Image& image, glm::vec4 value) override;
    void cleared(const Buffer& buffer) override;

private:
    void add(const PassCost& cost);

    const GlslChange change_{"counted", with_counters};
    std::vector<ShaderCounter> counters_;  ///< of the pass that runs
    std::vector<PassCost> costs_;
};
