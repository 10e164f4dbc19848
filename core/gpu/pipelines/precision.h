#pragma once
#include "core/gpu/image.h"

#include <functional>
#include <map>
#include <string>

/// What a study of precision changes about the passes of a graph, without their knowing. An empty function changes
/// nothing.
struct Precision {
    /// The format in which an image is made that is asked for as `image` (histories: without their "#0" and "#1").
    std::function<Format(const std::string& image, Format asked)> format_of;
    /// Whether the shader of a compute or fragment pass calculates in double. What it reads and writes stays as it is:
    /// images, filters, buffers and parameters hold floats. The device must have doubles (Device::has_doubles()).
    std::function<bool(const std::string& stage)> is_double;
};

/// What becomes of one shader before it is compiled.
struct ShaderChanges {
    bool is_double = false;
    std::map<std::string, Format> image_formats;  ///< in place of those that it declares, by the images' names
    bool is_counted = false;                      ///< see counted_shader.h
    bool is_for_gpu = false;                      ///< as a GPU gets it, on whatever device
    bool is_for_cpu = false;  ///< the form of shader_prelude_for_cpu(); not in double, counted or for a GPU
};

/// Formats of as many channels in 32 bits and in 16, of any that holds fractions; depth, stencil and whole numbers
/// stay. Of formats without alpha (r11g11b10f) those with one, in which it is what the shader writes.
Format as_float32(Format format);
Format as_float16(Format format);

/// "rgba16f": as GLSL and this project call it.
std::string name_of(Format format);
