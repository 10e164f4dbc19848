#pragma once
#include "experiments/bridges/shader_export/frame_passes.h"

#include <nlohmann/json.hpp>

/// A technique's exported files by name, and passes.json, which describes them.
struct ShaderExport {
    std::map<std::string, std::string> files;
    nlohmann::json description;
};

/// `frames`: of one screen; `other`: of another screen, which tells how sizes depend on the screen (screen_share.h).
/// Fails with Error if the two have other shaders, or if a pass runs in the first frame only.
ShaderExport describe_export(const PointConfig& point, const FramePasses& frames, const FramePasses& other);
