#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <vector>

/// How much of an image shows what, by the surface that the ray through each pixel's centre meets: shares of all
/// pixels, in [0, 1].
struct ViewShares {
    std::vector<double> of_material;  ///< by index into Scene::materials
    std::vector<double> of_instance;  ///< by index into Scene::instances
};

/// Of one frame of one camera. Reads no texture but those of masks. Fails with MachineError if Embree runs out of
/// memory.
ViewShares view_shares(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);
