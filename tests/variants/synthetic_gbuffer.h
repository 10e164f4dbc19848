#pragma once
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/scene/camera.h"

#include <functional>
#include <limits>

/// What a ray from the camera meets, for G-buffers made by formulas.
struct SyntheticHit {
    float distance = std::numeric_limits<float>::infinity();  ///< along the unit ray (m)
    glm::vec3 normal{0, 0, 1};                                ///< world space, geometric and shading
    float roughness = 1, metalness = 0, specular = 0;
    glm::vec3 lit{0};
    glm::vec3 dielectric_f0{0.04f};
};
using SyntheticScene = std::function<SyntheticHit(const CameraRay&)>;

/// The images that techniques read, filled at the pixel centres (moved by the jitter) and uploaded.
GBuffer upload_gbuffer(PassList& pass_list, const CameraPose& pose, const CameraData& camera,
                       const SyntheticScene& scene);

/// The same on the CPU.
HostGBuffer host_gbuffer(Device& device, const CameraPose& pose, const FrameView& view, const SyntheticScene& scene);

/// As GBuffer::motion, of a scene that has moved by `way` (world space) since the previous frame of `camera`.
HostImage motion_of(const CameraPose& pose, const CameraData& camera, const SyntheticScene& scene,
                    glm::vec3 way = glm::vec3(0));

/// A mirror floor at y = -1 before a wall at z = -6 that is white above y = 1 and grey (0.25) below, seen from the
/// origin.
SyntheticHit mirror_floor(const CameraRay& ray);
