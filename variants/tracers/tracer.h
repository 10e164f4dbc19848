#pragma once
#include "variants/common/condition.h"

/// What a tracer's shader reads besides the images of a G-buffer.
struct TracerNeeds {
    unsigned nearest_mips = 0;   ///< levels at most of `depth_pyramid`; 0: none
    unsigned farthest_mips = 0;  ///< of `farthest_depth_pyramid`
    bool depth_layers = false;   ///< GBuffer::second_depth and ::back_depth; shaders see TRACER_HAS_DEPTH_LAYERS
    bool random = false;         ///< TraceRay::random: another seed may find another end
    bool exact_hits = false;     ///< RayProbe::exact_hits of core/ray_probe.h
};

/// Why results depend on the order in which threads ran, as of Technique::not_repeatable(), where `when` holds.
struct NotRepeatable {
    Condition when;
    std::string because;
};

/// `not_repeatable` of a file.
std::vector<NotRepeatable> read_reasons(JsonObject& owner, const KnownValues& known);
/// Of the first reason that holds; "" without one.
std::string because(const std::vector<NotRepeatable>& reasons, const KnownValues& known);

/// A way to trace rays, as a file of variants/tracers/<folder>/ declares it: its page of the catalogue, its parameters
/// and its needs. What it does stands in its shader, which defines `TraceEnd <name>_trace(TraceRay)` of trace.glsl.
struct TracerEntry {
    std::string name, title, source, description;
    std::string shader;                       ///< "tracers/dda/dda.glsl"
    std::string part;                         ///< what its parameters' names begin with, before the dot
    bool fits_webgl2 = true;                  ///< what it reads and its shader lie within Limits::webgl2
    std::vector<Parameter> parameters;        ///< under their whole names: `dda.thickness`, in GLSL dda_thickness
    std::string nearest_mips, farthest_mips;  ///< parameters with the levels of both pyramids; "": it reads none
    Condition depth_layers = Condition::never(), random = Condition::never();
    bool exact_hits = false;
    std::vector<NotRepeatable> not_repeatable;
    std::string content_hash;  ///< of what declares it
};

/// The tracer that variants/tracers/<file> declares; its name is the file's. Fails with Error, which names the place,
/// on what is wrong in it.
TracerEntry read_tracer(const std::string& file);
