#pragma once
#include "core/error.h"

/// What glslang says of one of ssrlab's own shaders: the only message of several lines, which is printed as it is.
struct ShaderError : Error {
    using Error::Error;
};
