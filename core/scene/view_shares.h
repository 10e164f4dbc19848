#pragma once
#include "core/scene/camera.h"

#include <vector>

/// How much of an image shows what, by the nearest surface at each pixel's centre: shares of all pixels, in [0, 1].
struct ViewShares {
    std::vector<double> of_material;  ///< by index into Scene::materials
    std::vector<double> of_instance;  ///< by index into Scene::instances
};

/// The shares of one frame of one camera, between its planes. Masks do not count: a material also has the pixels that
/// its mask cuts out. A depth buffer on the CPU finds them in less time than Embree takes to start.
ViewShares view_shares(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);
