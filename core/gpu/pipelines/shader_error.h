#pragma once
#include "core/error.h"

/// glslang's message about one of ssrlab's own shaders. It is the only message of several lines, and printed unchanged.
struct ShaderError : Error {
    using Error::Error;
};
