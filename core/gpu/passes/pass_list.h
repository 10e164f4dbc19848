#pragma once
#include "core/gpu/image.h"
#include "core/gpu/passes/limits.h"
#include "core/gpu/pipelines/pipeline_recipe.h"
#include "core/host_image.h"
#include "core/parameters.h"
#include "core/shared/camera.h"

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>

class Device;
class PassWatcher;

/// The time of one stage: the label of its pass, by default the shader's path without extension.
struct PassTime {
    std::string stage;
    double milliseconds = 0;
};

/// How stages are timed. On a CPU device time stamps inside a command buffer do not enclose the work, so there each
/// pass is one submission that the host waits for. On a GPU all passes of a frame are one submission with time stamps
/// between them.
enum class Clock { host_fence, gpu_timestamp };

enum class Wrap { clamp, repeat, mirrored_repeat };

/// How a shader reads an image through a sampler.
struct Sampling {
    bool is_linear = false;
    Wrap wrap_u = Wrap::clamp, wrap_v = Wrap::clamp;
};

struct Read {
    Image image;
    Sampling sampling;
};

/// One indexed mesh of a drawing pass. Vertices are pulled by the vertex shader from storage buffers, with
/// gl_VertexIndex and gl_InstanceIndex (= first_instance), so there is no vertex layout to declare. `reads` are bound
/// for this draw only.
struct Draw {
    Buffer indices;  ///< uint32
    unsigned first_index = 0, index_count = 0;
    int vertex_offset = 0;
    unsigned first_instance = 0;
    enum class Cull { none, back, front } cull = Cull::none;  ///< front faces are counter-clockwise in the image, y up
    std::vector<Read> reads;
    std::vector<Buffer> buffers;
};

/// Called for each added pass with its stage and the images that it writes, for PassList::download().
using PassObserver = std::function<void(const std::string& stage, std::span<const Image> written)>;

/// Changes that a study makes to passes of a pass_list, unknown to the passes. An empty function changes nothing.
struct PassChanges {
    /// The format of an image that was requested as `image` (histories: without their "#0" and "#1").
    std::function<Format(const std::string& image, Format asked)> format_of;
    /// The change of a compute or fragment pass's shader; nullopt: none.
    std::function<std::optional<GlslChange>(const std::string& stage)> glsl_of;
};

/// A list of GPU passes, executed in the order in which they are added. Images, buffers and shader resources are
/// matched by name. The pass_list creates images, compiles shaders, binds resources, puts barriers between passes and
/// times each pass.
///
/// Shader files hold plain GLSL without #version, bindings or locations of inputs. The pass_list adds the `camera`
/// block, `#include` (from the project's root) and the parameters of the technique. A sampler2D, an image2D or a buffer
/// block is bound to the image or buffer of its name; a fragment output is written to the image of its name.
class PassList {
public:
    /// `extent`: of images requested without one. Without `clock` the device decides it.
    PassList(Device& device, glm::uvec2 extent);
    PassList(Device& device, glm::uvec2 extent, Clock clock);
    ~PassList();
    PassList(const PassList&) = delete;
    PassList& operator=(const PassList&) = delete;

    /// The image of that name; created on first use with undefined content, kept for the following frames. The extent
    /// is the pass_list's divided by `divisor`, rounded down, at least 1. Asking again with another format, size or mip
    /// count makes a new one.
    Image image(const std::string& name, Format format, unsigned mips = 1, unsigned divisor = 1);
    /// The same with an extent of its own (pixels).
    Image image_of(const std::string& name, Format format, glm::uvec2 extent, unsigned mips = 1);
    /// The same, with zeros at first.
    Image image_black_at_first(const std::string& name, Format format, glm::uvec2 extent);
    /// The storage buffer of that name, with zeros at first; `bytes` a multiple of 4.
    Buffer buffer(const std::string& name, size_t bytes);

    /// This frame's and the last frame's content of one image, exchanged by begin_frame(). Both are black at first.
    struct History {
        Image current, previous;  ///< named `name` and `previous_<name>`
    };
    /// Has the pass_list's extent, or `extent`.
    History history(const std::string& name, Format format);
    History history(const std::string& name, Format format, glm::uvec2 extent);

    class Pass;
    Pass compute(const std::string&
                     shader);  ///< "mcguire_dda/trace.comp", found under variants/, core/shaders/ or the project's root
    Pass fragment(const std::string& shader);  ///< over the whole of its outputs
    /// Draws meshes one after the other; the vertex shader places them.
    Pass draw(const std::string& vertex_shader, const std::string& fragment_shader, std::vector<Draw> draws);

    /// Starts a frame: forgets the times of the last one and exchanges histories. Every pass may use `camera`, `params`
    /// and `inputs` by name. `params` must outlive the frame.
    void begin_frame(const CameraData& camera, const ParameterSet& params, std::span<const Image> inputs);

    /// Sets specialization constants (parameters with Use::constant, or scene_constants()) for the rest of the frame,
    /// instead of the parameters' values. Later passes are compiled without the work that they switch off. Replaces the
    /// constants of the last call.
    void set_constants(Constants constants);

    /// Calls `observer` for each later pass ({}: none). Images then begin as zeros, so that it never sees unwritten
    /// memory.
    void observe(PassObserver observer);

    /// Whether passes with one form for CPUs and another for GPUs take the form for GPUs. The device decides until it
    /// is set.
    bool uses_gpu_forms() const;
    void use_gpu_forms(bool uses_them);

    /// Applies to passes and images requested later.
    void set_changes(PassChanges changes);
    /// The name by which `image` was requested; "" for an image of another pass_list.
    std::string asked_name(const Image& image) const;

    /// Replaces the parameters of begin_frame() for later passes. For parts with their own parameters, whose shaders
    /// name them without the part's name. `params` must outlive the frame, and not change until it ends.
    void set_params(const ParameterSet& params);
    const ParameterSet& params() const;

    /// Replaces the inputs of begin_frame() for later passes.
    void set_inputs(std::span<const Image> inputs);
    /// Whether there is an input of that name.
    bool has_input(const std::string& name) const;

    void clear(const Image& image,
               glm::vec4 value);  ///< all its mips; timed as the stage "clear"; depth: x depth, y stencil
    void clear(const Buffer& buffer, uint32_t value);  ///< each of its words of 4 bytes; the same stage
    /// Uploads fail with Error where extent, channels or size differ from those of the image or buffer.
    void upload(const Image& image,
                const HostImage& pixels);  ///< one mip, same extent and channel count; converted to the format
    void upload_rgba8(const Image& image, std::span<const uint8_t> texels);  ///< one mip, 4 bytes a texel, row by row
    void upload(const Buffer& buffer, std::span<const std::byte> bytes);     ///< all of it
    HostImage download(const Image& image);  ///< mip first_mip; as many channels as the format has; depth: one
    std::vector<std::byte> download(const Buffer& buffer);

    /// Stages since begin_frame(), in order; a stage run several times is summed. On a GPU this waits for the frame.
    std::vector<PassTime> times();
    /// ms, from the first to the last command of the frame; the sum of stages on a CPU.
    double frame_milliseconds();

    /// Reports all that the pass_list does to `watcher` (nullptr: nobody), which must live as long.
    void watch(PassWatcher* watcher);

    Clock clock() const;
    glm::uvec2 extent() const;
    Device& device();

    struct Impl;

private:
    friend class LimitScope;
    std::unique_ptr<Impl> impl_;
};

/// One pass, described and then run by run() or dispatch().
class PassList::Pass {
public:
    Pass& read(const Image& image, Sampling sampling = {});  ///< through a sampler of the image's name
    Pass& read_linear(const Image& image) { return read(image, {.is_linear = true}); }
    Pass& write(const Image& image);  ///< a storage image of a compute pass, else an output of the fragment shader
    Pass& use(const Buffer& buffer);  ///< to read or to write
    Pass& stencil(Stencil stencil);  ///< for fragment passes and draws; without it no stencil test, and without depth()
                                     ///< no depth test
    Pass& depth(DepthTest test);
    Pass& set(const std::string& name, float value);  ///< a member of the shader's push_constant block
    Pass& set(const std::string& name, int value);
    Pass& set(const std::string& name, unsigned value);
    Pass& set(const std::string& name, glm::vec4 value);
    Pass& include(const std::string& name, std::string glsl);  ///< what `#include "name"` stands for in this pass
    Pass& label(std::string stage);                            ///< name of the stage; else the shader's path
    const std::string& stage() const { return label_; }

    /// Compute: one invocation per pixel of the first written image, or of `extent`; fragment, draw: over the outputs.
    void run();
    void run(glm::uvec2 extent);
    void dispatch_groups(glm::uvec3 groups);                    ///< compute: so many workgroups
    void dispatch(const Buffer& arguments, size_t offset = 0);  ///< three uints: numbers of groups

private:
    friend class PassList;
    friend struct PassList::Impl;
    Pass(PassList::Impl& pass_list, std::string shader, bool is_compute);

    PassList::Impl& pass_list_;
    std::string shader_, vertex_shader_, label_;
    bool is_compute_;
    std::vector<Read> reads_;
    std::vector<Image> writes_;
    std::vector<Buffer> buffers_;
    std::vector<Draw> draws_;
    Stencil stencil_;
    DepthTest depth_;
    std::map<std::string, std::string> includes_;
    struct PushValue {
        std::string name;
        std::array<float, 4> bits;
        unsigned size;
    };
    std::vector<PushValue> pushes_;
};
