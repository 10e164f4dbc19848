#pragma once
#include "core/gpu/image.h"
#include "core/parameters.h"
#include "core/shared/camera.h"

#include <chrono>
#include <filesystem>
#include <span>

class Device;

struct PassTime {
    std::string pass;
    std::chrono::duration<double, std::milli> time;
};

/// How a full-screen fragment pass uses the stencil buffer: write a value, or draw only where it is found.
struct Stencil {
    enum class Mode { off, write, keep_equal } mode = Mode::off;
    unsigned value = 0;
    Image image;
};

/// A list of GPU passes, executed in the order in which they are added. Images and shader resources meet by name; the
/// graph creates the images, compiles the shaders, binds, separates the passes by barriers and times each of them.
class PassGraph {
public:
    PassGraph(Device& device, glm::uvec2 extent, std::vector<std::filesystem::path> shader_roots);
    ~PassGraph();

    /// The image of that name; created on first use, kept for the following frames.
    Image image(std::string name, Format format, unsigned mips = 1, unsigned divisor = 1);

    /// This frame's and the last frame's content of one image, exchanged by begin_frame().
    struct History { Image current, previous; };
    History history(std::string name, Format format);

    class Pass;
    Pass compute(std::string shader);
    Pass fragment(std::string shader);

    /// Values which every pass of the frame may use by name.
    void begin_frame(const CameraData& camera, const ParameterSet& params, std::span<const Image> inputs);

    std::vector<float> download(const Image& image);  ///< rgba32f pixels, row by row
    void clear(const Image& image, glm::vec4 value);
    const std::vector<PassTime>& times() const;       ///< of this frame, in order
    glm::uvec2 extent() const;

    struct Impl;
private:
    std::unique_ptr<Impl> impl_;
};

class PassGraph::Pass {
public:
    Pass& read(const Image& image, bool linear = false);
    Pass& write(const Image& image);
    Pass& stencil(Stencil stencil);
    void run();  ///< over the extent of the first written image

private:
    friend class PassGraph;
    Pass(PassGraph::Impl& graph, std::string shader, bool is_compute) : graph_(graph), shader_(std::move(shader)), is_compute_(is_compute) {}

    struct Read { Image image; bool linear; };
    PassGraph::Impl& graph_;
    std::string shader_;
    bool is_compute_;
    std::vector<Read> reads_;
    std::vector<Image> writes_;
    Stencil stencil_;
};
