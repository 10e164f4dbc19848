#pragma once
#include "experiments/bridges/shader_export/standalone_glsl.h"
#include "experiments/gpu_costs/spirv/shader_layout.h"

#include <nlohmann/json.hpp>

// What passes.json says of one shader.

/// Its uniform blocks and storage buffers with their members. `glsl`: its exported text.
nlohmann::json described_blocks(const FrameCommand& command, const ShaderLayout& layout, const std::string& glsl);

nlohmann::json described_constants(const StandaloneGlsl& glsl);

/// The members of its push_constant block with their values. `earlier`: the same run of the frame before, which tells
/// what changes; null: there is none.
nlohmann::json described_push(const FrameCommand& command, const FrameCommand* earlier, const ShaderLayout& layout);
