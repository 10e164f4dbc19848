#pragma once
#include "experiments/bridges/shader_export/frame_passes.h"

/// A specialization constant of an exported shader.
struct ExportedConstant {
    std::string name, type, value;  ///< in GLSL
    unsigned id = 0;
    const Parameter* parameter = nullptr;  ///< of FrameCommand::params; null: a fact about the scene
};

struct StandaloneGlsl {
    std::string text;
    std::vector<ExportedConstant> constants;  ///< that the text names
};

/// A pass's shader as one text for any compiler of Vulkan GLSL. Files that are included twice appear once. Each
/// specialization constant has the chosen value as its default, and each resource has its set and binding. Constants,
/// parameters and resources that nothing names are left out. `head`: lines of comment that begin the text.
StandaloneGlsl standalone_glsl(const FrameCommand& pass, const std::string& head);

/// The shader of a triangle over the whole image, which is the vertex stage of all fragment passes.
std::string fullscreen_vertex_glsl(const std::string& head);

/// The value as GLSL writes it: "3u", "0.5", "true". `bits`: as the GPU stores it; `type`: bool, int, uint or float.
std::string glsl_literal(const std::string& type, uint32_t bits);
