#pragma once
#include "tests/variants/diligent_golden.h"

#include <functional>

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

/// Runs that pass on given inputs; what it leaves out keeps the values of the run before. `targets`: decides the
/// formats in place of `parameters`, of which alone the shader knows.
struct ReconstructionBench {
    PassList pass_list;
    DiligentParameters parameters;

    ReconstructionBench(Device& device, glm::uvec2 extent, const nlohmann::json& overrides);
    Reconstruction run(const ReconstructionInputs& inputs, const DiligentFilterParameters* targets = nullptr);
};

/// One ray as intersection stores it; the default goes back towards an orthographic camera.
struct TexelRay {
    glm::vec3 radiance{0.5f};
    float confidence = 1;
    glm::vec3 direction{0, 0, 1};  ///< times length (m)
    float density = 1;             ///< sr^-1
};

/// A wall across the whole view, facing the camera at the origin, with rays per texel.
struct ReflectingWall {
    glm::uvec2 extent{32, 32}, ray_extent = extent;
    bool is_orthographic = true;  ///< else 60 degrees high
    glm::vec2 jitter{0};          ///< of the camera (pixels)
    float distance = 4;           ///< m
    float roughness = 0.5f;       ///< perceptual
    std::function<TexelRay(unsigned x, unsigned y)> ray = [](unsigned, unsigned) { return TexelRay{}; };
};
ReconstructionInputs reflecting_wall(const ReflectingWall& wall);
