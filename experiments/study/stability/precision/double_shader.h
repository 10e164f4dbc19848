#pragma once
#include "core/gpu/passes/pass_list.h"

/// The shader, expanded and without #version, as one that calculates in double: every float, vector, matrix and literal
/// of its functions becomes one of doubles. Uniforms, buffers and outputs keep their layout, and are rounded to where
/// they are written. `functions`: double_functions.glsl. It is text for text the same algorithm.
std::string in_double(const std::string& glsl, const std::string& functions);

/// Lets the shaders of the stages that `is_double` names calculate in double. What they read and write stays as it is:
/// images, filters, buffers and parameters hold floats. The device must have doubles (Device::has_doubles()).
std::function<std::optional<GlslChange>(const std::string& stage)> double_where(
    std::function<bool(const std::string& stage)> is_double);
