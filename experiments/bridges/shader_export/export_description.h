#pragma once
#include "experiments/bridges/shader_export/frame_passes.h"

#include <nlohmann/json.hpp>

/// A technique's exported files by name, and passes.json, which describes them.
struct ShaderExport {
    std::map<std::string, std::string> files;
    nlohmann::json description;
};

/// `frames`: of one screen; `at_double`: of a screen of twice the width and height, by which sizes are told that grow
/// with the screen. Fails with Error if the two have other passes, or if a pass runs in the first frame only.
ShaderExport describe_export(const PointConfig& point, const FramePasses& frames, const FramePasses& at_double);
