#pragma once
#include "core/gpu/passes/pass_graph.h"

/// What rays found, by index of the ray: (y * width + x) * max_rays + k for ray k of a traced pixel (ray.glsl). In 32
/// bits: densities overflow halves below a roughness of 0.033.
struct TracedRays {
    Buffer directions;  ///< vec4: xyz view space, unit, w 1 / density of the direction (sr); w = 0: no ray
    Buffer hits;        ///< uvec4: x pixel (x | y << 16) or a marker of ray.glsl; y, z bits of: length (m), confidence
};
