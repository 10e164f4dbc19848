#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/counted_shader.h"

#include <array>

/// What one stage of a frame did, counted by its shaders. If its results are the same on all devices and in all runs,
/// so are its counts.
///
/// Bytes are those that instructions ask for, in the format of the image or buffer. Caches, compression of images and
/// padding of texels are ignored. Not counted: vertex shaders and what they read, indices, tests of depth and stencil
/// and their writes, uniform blocks, push constants, sizes of images, uploads.
struct PassCost {
    std::string stage;
    uint64_t invocations = 0;    ///< started compute and fragment invocations, without helpers of derivatives
    uint64_t idle = 0;           ///< invocations that wrote nothing: beyond the edge, without work, discarded
    uint64_t fetches = 0;        ///< instructions that read images
    uint64_t texels = 0;         ///< texels of fetches: 1 each, 4 for a gather or linear filter, 8 with mips
    uint64_t bytes_read = 0;     ///< from images and buffers
    uint64_t bytes_written = 0;  ///< to images, buffers and colour targets; a clear: its size
    /// Memory traffic if a cache forgot nothing during a pass. For each image and buffer: the lesser of its size and
    /// the bytes read, and likewise for bytes written.
    uint64_t unique_bytes = 0;
    uint64_t shared_bytes = 0;  ///< read from and written to the workgroup's memory
    uint64_t atomics = 0;       ///< atomic instructions; their 4 bytes count as read and written
    uint64_t operations = 0;    ///< scalar arithmetic as the shader states it, see count_in() in counted_shader.h

    void add(const PassCost& other);  ///< adds the counts; `stage` stays
};

struct CostQuantity {
    const char* name;
    uint64_t PassCost::*member;
    const char* meaning;
};

inline constexpr std::array cost_quantities = {
    CostQuantity{"invocations", &PassCost::invocations, "Invocations of compute and fragment shaders that start"},
    CostQuantity{"idle", &PassCost::idle,
                 "Invocations that write nothing: beyond the image's edge, at the end of a list, or without work"},
    CostQuantity{"fetches", &PassCost::fetches,
                 "Instructions that read images: texelFetch, texture, textureGather, imageLoad"},
    CostQuantity{"texels", &PassCost::texels,
                 "Texels that fetches read: 1 each, 4 for a gather or a linear filter, 8 for a linear filter on an "
                 "image with mips"},
    CostQuantity{"bytes_read", &PassCost::bytes_read,
                 "Bytes of these texels in the image's format, and bytes read from storage buffers"},
    CostQuantity{"bytes_written", &PassCost::bytes_written,
                 "Bytes written by imageStore, to storage buffers, to colour targets and by clears"},
    CostQuantity{"unique_bytes", &PassCost::unique_bytes,
                 "Estimated memory traffic: for each image or buffer of a pass, the lesser of its size and what was "
                 "read or written"},
    CostQuantity{"shared_bytes", &PassCost::shared_bytes, "Bytes of shared memory that are read and written"},
    CostQuantity{"atomics", &PassCost::atomics, "Atomic instructions, whose 4 bytes also count as read and as written"},
    CostQuantity{"operations", &PassCost::operations,
                 "Scalar arithmetic as the compiled shader states it: 1 for each component of a result, 2n - 1 for a "
                 "dot product of n numbers; no loads, moves or branches"},
};

/// Makes the passes of a pass list count what they do, at the price of compiling a second pipeline for each shader.
class CostCounter : public PassWatcher {
public:
    /// Costs by stage since the frame began or the pass list was watched, in order; runs of one stage are added.
    const std::vector<PassCost>& costs() const { return costs_; }

    void begin_frame() override { costs_.clear(); }
    const GlslChange* glsl_change() const override { return &change_; }
    std::optional<InstrumentedPipeline> before(const PassRun& run) override;
    /// Fails with Error if the device's own count of invocations differs from the shader's.
    void after(const PassRun& run, std::span<const std::byte> content) override;
    void cleared(const Image& image, glm::vec4 value) override;
    void cleared(const Buffer& buffer) override;

private:
    void add(const PassCost& cost);

    const GlslChange change_{"counted", with_counters};
    std::vector<ShaderCounter> counters_;  ///< of the running pass
    std::vector<PassCost> costs_;
};
