#pragma once
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "tests/variants/diligent_passes.h"
#include "tests/variants/golden_gbuffer.h"

// Recorded sets of DiligentFX: single frames ("still" sets), and sequences with the folders f0, f1 ... Their view is
// left-handed and their motion in units of NDC, y up; both are turned into our conventions.

/// The parameters of all passes, for tests that run them one by one.
struct DiligentParameters {
    DiligentParameters();

    ParameterSet params;
    DiligentTracingParameters tracing{params};
    DiligentFilterParameters filter{params};
};

/// Sets that hold that file: "gbuffer.exr", "f0/aux.exr". A set in the index need not be whole.
std::vector<std::string> diligent_sets_with(const std::string& file);
/// Sets that hold a single frame, and sets that hold a sequence.
std::vector<std::string> diligent_still_sets();
std::vector<std::string> diligent_sequences();

/// Frames of the sequence: they are numbered 0 to this - 1.
unsigned diligent_frame_count(const std::string& sequence);
/// "SEQUENCE/f3/": where the files of a frame are.
std::string diligent_frame_folder(const std::string& sequence, unsigned frame);

/// The inputs of a still set: its previous camera and depth are its own. Every surface is a metal, so that all reflect.
HostGBuffer diligent_golden_gbuffer(const std::string& set);
/// The same of a frame of a sequence, with the depth and normals of the frame before; the first frame has its own.
HostGBuffer diligent_golden_frame(const std::string& sequence, unsigned frame);

/// Our names and values of a still set's recorded parameter set: "p1", "p2", "p3".
nlohmann::json diligent_golden_parameters(const std::string& set, const std::string& name);
/// Those of a sequence; temporal_radiance_stability_factor was varied (0.9 and 1, in the names of files) and is left
/// out.
nlohmann::json diligent_sequence_parameters(const std::string& sequence);

/// What our preset changes that stands for a recorded technique: "head" (2026) or "seed" (2024).
nlohmann::json diligent_preset(const std::string& recorded_technique);
