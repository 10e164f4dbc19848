#pragma once
#include "core/error.h"
#include "core/gpu/device_impl.h"
#include "core/gpu/passes/pass_list.h"
#include "core/gpu/passes/pass_watcher.h"
#include "core/gpu/pipelines/pipeline.h"

#include <map>
#include <optional>

// The inside of PassList: pass_list.cpp makes resources, frame.cpp submits and times, pass.cpp describes and runs
// passes, binding.cpp finds what their shaders ask for, limits.cpp refuses what an API does not have, pass_watcher.cpp
// shows passes to a watcher.

// The uniform buffer: the camera block, then one block for each set of parameters that a frame's passes read. Offsets
// suit every device's alignment (256 at most).
inline constexpr size_t params_offset = 2048, params_size = 4096, max_params_of_frame = 4;
inline constexpr size_t uniforms_size = params_offset + max_params_of_frame * params_size;
static_assert(sizeof(CameraData) <= params_offset);

/// The buffer of instrumented pipelines, kept as long as the device: traces take 128 MiB, and new memory takes longer
/// than the passes.
struct WatchedBuffer {
    std::shared_ptr<BufferStorage> storage;
    DeviceBuffer host;
    size_t size = 0;  ///< bytes of both

    void grow(Device::Impl& gpu, size_t bytes);
    /// The first bytes, until the next call.
    std::span<const std::byte> content(Device::Impl& gpu, size_t bytes) const;
};

struct PassList::Impl {
    Device& device;
    Device::Impl& gpu;
    glm::uvec2 extent;
    Clock clock;
    PipelineCache& pipelines;
    DeviceBuffer uniforms;
    std::map<std::string, Image> images, inputs;
    std::map<std::string, Buffer> buffers;
    unsigned parity = 0;
    const ParameterSet no_parameters;  ///< until the first begin_frame()
    const ParameterSet* params = &no_parameters;
    std::vector<const ParameterSet*> params_of_frame;  ///< in the order of their blocks
    std::map<std::array<int, 3>, vk::raii::Sampler> samplers;
    Limits limits = Limits::none;
    Constants constants;
    PassObserver observer;
    bool uses_gpu_forms = !gpu.info.is_cpu();
    PassChanges changes;
    PassWatcher* watcher = nullptr;
    std::map<std::string, Pipeline> watched_pipelines;  ///< by the bytes of their recipes
    vk::raii::QueryPool device_counts{nullptr};         ///< of invocations, once a pass was watched that has them

    std::vector<PassTime> times;
    double frame_milliseconds = 0;
    // On a GPU only: what has been recorded since begin_frame() or the last flush.
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence fence{nullptr};
    vk::raii::QueryPool queries{nullptr};
    std::vector<std::string> recorded;

    Impl(Device& device, glm::uvec2 extent, Clock clock);
    ~Impl();

    void execute(const std::string& stage, const std::function<void(const vk::raii::CommandBuffer&)>& record);
    void flush();
    void add_time(const std::string& stage, double milliseconds);

    /// Records the commands of a pass with a pipeline.
    using Recording = std::function<void(const vk::raii::CommandBuffer&, const Pipeline&)>;
    /// Shows the pass to the watcher, and runs it as the watcher wants. false: the pass has not run, and must run
    /// unchanged.
    bool run_watched(Pass& pass, ShaderChanges changes, const PipelineState& state, const std::vector<Image>& targets,
                     const std::function<glm::uvec3()>& groups, const Recording& record);

    static std::vector<std::byte> push_block(const Pass& pass, const ShaderInterface& interface);

    ShaderChanges changes_of(const Pass& pass) const;
    /// Pixels of a fragment pass or of drawn meshes.
    static glm::uvec2 area_of(const Pass& pass, const std::vector<Image>& attachments);
    const vk::raii::Sampler& sampler(const Sampling& sampling);
    void run(Pass& pass, std::optional<glm::uvec3> groups, const Buffer* arguments, size_t arguments_offset);
    void check(const Pass& pass, const ShaderInterface& interface);
    void require(const Image& image, vk::FormatFeatureFlagBits feature, const char* what);
    /// allow_use() for all that the pass stores to and draws to; call it before recording its commands.
    void allow_uses(const Pass& pass, const ShaderInterface& interface, const std::vector<Image>& targets);
    void check_limits(const Pass& pass, const Shader& shader, const std::vector<Image>& targets);
    void check_resources(const Pass& pass, const ShaderInterface& interface, const std::vector<Image>& drawn);
    void check_limits(const Buffer& buffer);
    void check_upload_limits(const Image& image);
    void bind(const vk::raii::CommandBuffer& commands, const Pass& pass, const Draw* draw, const Pipeline& pipeline);
    void draw(const vk::raii::CommandBuffer& commands, const Pass& pass, const Pipeline& pipeline,
              const std::vector<Image>& attachments);
    [[noreturn]] void fail_missing(const Pass& pass, const std::string& name);
    const Image* find_image(const Pass& pass, const Draw* draw, const std::string& name, Sampling& sampling);
    const Buffer* find_buffer(const Pass& pass, const Draw* draw, const std::string& name);
    /// Offset of the block of `params` in the uniform buffer.
    size_t params_place() const;
    void write_params();
};
