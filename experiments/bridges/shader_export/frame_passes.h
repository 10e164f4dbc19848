#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/study/config/config.h"

#include <filesystem>
#include <map>

/// An image or a buffer as one command of a frame uses it.
struct UsedResource {
    std::string variable;  ///< in the shader; of a buffer the name of its block
    std::string resource;  ///< what the technique calls it, without "previous_"; of an input the variable's name
    const void* storage = nullptr;  ///< tells the two sides of a history apart
    Format format{};                ///< of an image
    glm::uvec2 extent{0, 0};        ///< of its first mip, pixels
    unsigned mips = 1, first_mip = 0;
    size_t bytes = 0;  ///< of a buffer
    Sampling sampling;
    bool is_input = false;  ///< not the technique's own: the engine supplies it
};

/// A pass, or a clear, of one frame.
struct FrameCommand {
    std::string stage, shader;
    std::string glsl;  ///< of the compute or fragment shader, expanded, as it was compiled; "": a clear
    PipelineRecipe recipe;
    std::string pipeline;  ///< equal for passes of one stage and one recipe; "": a clear
    ParameterSet params;   ///< of its shader
    Constants constants;   ///< that replace values of `params`
    glm::uvec3 groups{0};  ///< of a compute pass
    std::vector<UsedResource> samplers, images, buffers, targets;
    std::vector<std::byte> push;
    DepthTest depth;  ///< without an image: no test
    Stencil stencil;
    std::optional<UsedResource> depth_image, stencil_image;
    std::string clear_value;  ///< of a clear

    bool is_clear() const { return glsl.empty(); }
};

/// The texels of an image that no command writes, as the image's format stores them.
struct FixedTexels {
    UsedResource image;
    std::vector<std::byte> texels;  ///< row by row
};

/// The first two frames of a technique in its forms for GPUs: one without history, one with history.
struct FramePasses {
    /// Where the reflections are after the second frame: see core/gbuffer/reflections.h.
    struct Result {
        std::string radiance, confidence;
        unsigned confidence_channel = 0;
    };

    glm::uvec2 screen;                    ///< pixels
    std::vector<FrameCommand> frames[2];  ///< in order of execution
    std::vector<FixedTexels> fixed;       ///< by name
    Result result;
};

/// Renders the frames in the scene mirror_pillars; nothing is left out. Fails with Error if the technique reads scene
/// data on the CPU, draws meshes, or has no passes.
FramePasses frame_passes(Device& device, const PointConfig& point, glm::uvec2 screen,
                         const std::vector<std::filesystem::path>& scene_path);
