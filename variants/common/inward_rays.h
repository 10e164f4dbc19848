#pragma once
#include "core/parameters.h"

/// What becomes of rays that shading normals or sampling turn below the geometric surface that they start from.
/// `initial`: what the technique's original does. Shaders: inward_rays.glsl.
inline Choice inward_rays_parameter(ParameterSet& params, std::string initial, std::string source) {
    return Choice(params, "inward_rays", std::move(initial), {"traced", "missed", "black"},
                  {"",
                   "what becomes of rays below the geometric surface that they start from. traced: as of all others; "
                   "missed: they count as misses; black: they meet that surface and bring no light",
                   std::move(source)});
}
