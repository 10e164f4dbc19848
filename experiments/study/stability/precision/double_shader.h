#pragma once
#include "core/gpu/passes/pass_list.h"

/// Returns the shader (expanded, without #version) with double arithmetic: every float, vector, matrix and literal of
/// its functions becomes double. Uniforms, buffers and outputs keep their layout; values are rounded where they are
/// written. Otherwise the text is the same algorithm. `functions`: double_functions.glsl.
std::string in_double(const std::string& glsl, const std::string& functions);

/// A change of shaders that makes the stages for which `is_double` is true calculate in double. Images, filters,
/// buffers and parameters still hold floats. The device must support doubles (Device::has_doubles()).
std::function<std::optional<GlslChange>(const std::string& stage)> double_where(
    std::function<bool(const std::string& stage)> is_double);
