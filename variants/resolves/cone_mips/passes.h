#pragma once
#include "variants/resolves/cone_mips/parameters.h"
#include "variants/resolves/resolve.h"

/// Reflections from mips of what each pixel's own rays see. Shaders also read max_roughness and half_resolution.
Reflections cone_mips(PassGraph& graph, const OwnRays& own, bool half_resolution);
