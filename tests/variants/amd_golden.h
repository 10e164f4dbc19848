#pragma once
#include "core/gbuffer/gbuffer_transfer.h"
#include "tests/variants/golden_vectors.h"
#include "variants/amd_sssr/passes.h"
#include "variants/amd_sssr/tracing_parameters.h"

/// The parameters of all passes, for tests that run them one by one.
struct AmdParameters {
    ParameterSet params;
    TracingParameters tracing{params};
    DenoiserParameters denoiser{params};
};

/// The inputs of one recorded set as our G-buffer holds them: every surface is a metal, so that all reflect. The
/// environment is the recorded constant.
HostGBuffer amd_golden_gbuffer(const std::string& set);

/// The same with the colour (u, v, 1) of each pixel and a black environment, from which hits can be decoded.
HostGBuffer amd_golden_hit_gbuffer(const std::string& set);

/// Sets that hold recorded passes of the tracer: those with classify.exr.
std::vector<std::string> amd_tracer_sets();

/// Our names and values of a recorded parameter set: "p1" ... "p4", "pdef".
nlohmann::json amd_golden_parameters(const std::string& set, const std::string& name);
