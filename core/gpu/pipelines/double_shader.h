#pragma once
#include "core/gpu/pipelines/precision.h"

/// The shader, expanded and without #version, as one that calculates in double: every float, vector, matrix and literal
/// of its functions becomes one of doubles. Uniforms, buffers and outputs keep their layout, and are rounded to where
/// they are written. `functions`: precision/double_functions.glsl. It is text for text the same algorithm.
std::string in_double(const std::string& glsl, const std::string& functions);

/// The shader with other formats of its storage images (`layout(rgba32f) uniform image2D name`).
std::string with_image_formats(const std::string& glsl, const std::map<std::string, Format>& formats);
