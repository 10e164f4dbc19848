#pragma once
#include "core/parameters.h"

#include <functional>
#include <memory>
#include <string>

/// What a tracer's shader reads besides the images of a G-buffer.
struct TracerNeeds {
    unsigned nearest_mips = 0;   ///< levels at most of `depth_pyramid`; 0: none
    unsigned farthest_mips = 0;  ///< of `farthest_depth_pyramid`
    bool depth_layers = false;   ///< GBuffer::second_depth and ::back_depth; shaders see TRACER_HAS_DEPTH_LAYERS
    bool random = false;         ///< TraceRay::random: another seed may find another end
    bool exact_hits = false;     ///< RayProbe::exact_hits of core/ray_probe.h
};

/// The parameters of one way to trace rays, declared in the technique that may use it, with names that begin with the
/// tracer's: `dda.thickness`, in GLSL dda_thickness. What it does stands in its shader.
class Tracer {
public:
    explicit Tracer(ParameterSet& params) : params(params) {}
    virtual ~Tracer() = default;
    virtual TracerNeeds needs() const { return {}; }

    /// Why its ends depend on the order in which threads ran, where a technique's rays share subgroups in that order;
    /// as of Variant::not_repeatable().
    virtual std::string not_repeatable() const { return {}; }

protected:
    ParameterSet& params;
};

/// A tracer's page of the catalogue. `variants/tracers/<folder>/*.glsl` defines `TraceEnd <name>_trace(TraceRay)` of
/// trace.glsl.
struct TracerEntry {
    std::string name, title, source, description;
    std::string shader;       ///< "tracers/dda/dda.glsl"
    std::string part = {};    ///< what its parameters' names begin with; "": its own name
    bool fits_webgl2 = true;  ///< what it reads and its shader lie within Limits::webgl2
    /// Declares the parameters.
    std::function<std::unique_ptr<Tracer>(ParameterSet&)> create;
};
