#pragma once
#include "tests/variants/diligent_golden.h"

/// What DiligentFX's spatial reconstruction reads in one frame.
struct ReconstructionInputs {
    CameraData camera;
    HostImage depth, normal;                ///< as in GBuffer
    HostImage mask, roughness;              ///< 1 for each pixel kept; as in DiligentMask
    HostImage ray_radiance, ray_direction;  ///< as in DiligentRays
};

struct Reconstruction {
    HostImage radiance, variance, hit_depth;
};

/// Runs that pass on given inputs; what it leaves out keeps the values of the run before.
struct ReconstructionBench {
    PassGraph graph;
    DiligentParameters parameters;

    ReconstructionBench(Device& device, glm::uvec2 extent, const nlohmann::json& overrides);
    Reconstruction run(const ReconstructionInputs& inputs);
};
