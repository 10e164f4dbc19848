#pragma once
#include "variants/common/condition.h"

/// What a tracer's shader reads besides the images of a G-buffer.
struct TracerNeeds {
    unsigned nearest_mips = 0;   ///< most levels of `depth_pyramid`; 0: none
    unsigned farthest_mips = 0;  ///< most levels of `farthest_depth_pyramid`
    bool depth_layers = false;   ///< GBuffer::second_depth and ::back_depth; shaders see TRACER_HAS_DEPTH_LAYERS
    bool random = false;         ///< reads TraceRay::random: another seed may find another end
    bool exact_hits = false;     ///< reads RayProbe::exact_hits of core/ray_probe.h
};

/// If `when` holds, why results depend on the order of threads, as in Technique::not_repeatable().
struct NotRepeatable {
    Condition when;
    std::string because;
};

/// Reads `not_repeatable` of a file.
std::vector<NotRepeatable> read_reasons(JsonObject& owner, const KnownValues& known);
/// The text of the first reason that holds; "" without one.
std::string because(const std::vector<NotRepeatable>& reasons, const KnownValues& known);

/// A way to trace rays, as a file of variants/tracers/<folder>/ declares it: its page of the catalogue, its parameters
/// and its needs. Its shader defines `TraceEnd <name>_trace(TraceRay)` of trace.glsl.
struct TracerEntry {
    std::string name, title, source, description;
    std::string shader;                       ///< "tracers/dda/dda.glsl"
    std::string part;                         ///< the part of its parameters' names before the dot
    bool fits_webgl2 = true;                  ///< its shader and its inputs fit Limits::webgl2
    std::vector<Parameter> parameters;        ///< with full names: `dda.thickness`, in GLSL dda_thickness
    std::string nearest_mips, farthest_mips;  ///< parameters with the levels of each pyramid; "": not read
    Condition depth_layers = Condition::never(), random = Condition::never();
    bool exact_hits = false;
    std::vector<NotRepeatable> not_repeatable;
    std::string content_hash;  ///< of its declaration
};

/// The tracer that variants/tracers/<file> declares; its name is the file's. Fails with Error, which names the place,
/// if something is wrong.
TracerEntry read_tracer(const std::string& file);
