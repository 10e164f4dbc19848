#pragma once
#include "variants/resolves/reservoirs/parameters.h"
#include "variants/resolves/resolve.h"

/// Reflections from reservoirs of rays; what is not known of a ray is the fallback. Shaders also read max_roughness and
/// lobe.
Reflections reservoirs(PassGraph& graph, const GBuffer& gbuffer, const RayImages& rays);
