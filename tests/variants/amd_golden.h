#pragma once
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "tests/variants/amd_passes.h"
#include "tests/variants/golden_gbuffer.h"
#include "variants/common/depth_pyramid.h"

/// The parameters of all passes, for tests that run them one by one.
struct AmdParameters {
    AmdParameters();

    ParameterSet params;
    AmdTracingParameters tracing{params};
    AmdDenoiserParameters denoiser{params};
};

/// The inputs of one recorded set as our G-buffer holds them: every surface is a metal, so that all reflect. The
/// environment is the recorded constant.
HostGBuffer amd_golden_gbuffer(const std::string& set);

/// The same with the colour (u, v, 1) of each pixel and a black environment, from which hits can be decoded.
HostGBuffer amd_golden_hit_gbuffer(const std::string& set);

/// What the passes up to classification, or up to intersection, leave.
struct AmdTraced {
    std::vector<uint32_t> rays, tiles;  ///< the lists
    HostImage radiance;                 ///< rgb, w length of the ray (m)
    HostImage roughness, confidence;
    std::vector<uint32_t> arguments;  ///< after intersection
};

/// Runs one frame. `parameters` override the defaults; radiance is kept in 32 bits. `variance`: of the frame before, or
/// nullptr for the first frame.
AmdTraced amd_classify_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                             const HostImage* variance = nullptr);
/// The rays are intersected in the order in which one thread lists them, so that those which are given up with the rest
/// of their subgroup are the same in each run.
AmdTraced amd_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                          const HostImage& noise, RayProbe* probe = nullptr);

/// A map of what is listed: 1 + copy flags (bits 29 to 31 as 2, 4, 8), 0 where no ray is. Fails a test if a pixel is
/// listed twice or lies outside.
HostImage map_of_rays(const AmdTraced& traced, glm::uvec2 extent);
/// 1 where a tile is listed.
HostImage map_of_tiles(const AmdTraced& traced, glm::uvec2 extent);

/// Sets that hold recorded passes of the tracer: those with classify.exr.
std::vector<std::string> amd_tracer_sets();

/// Our names and values of a recorded parameter set: "p1" ... "p4", "pdef".
nlohmann::json amd_golden_parameters(const std::string& set, const std::string& name);
