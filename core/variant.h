#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/pass_graph.h"
#include "core/parameters.h"

/// What each variant estimates for each pixel of the G-buffer.
struct Reflections {
    Image radiance;    ///< mean incident radiance over the specular lobe, before the BRDF (rgb, W sr^-1 m^-2)
    Image confidence;  ///< 0 where the fallback should be used, 1 where `radiance` should
};

/// One screen-space reflection technique: its parameters and its passes in order.
class Variant {
public:
    virtual ~Variant() = default;

    /// Adds this frame's passes. Called once per frame, in temporal order, after PassGraph::begin_frame().
    virtual Reflections render(PassGraph& graph, const GBuffer& gbuffer) = 0;

    ParameterSet params;
};
