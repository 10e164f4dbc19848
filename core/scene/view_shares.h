#pragma once
#include "core/scene/camera.h"

#include <vector>

/// How much of an image shows what, by the nearest surface at each pixel's centre: shares of all pixels, in [0, 1].
struct ViewShares {
    std::vector<double> of_material;  ///< by index into Scene::materials
    std::vector<double> of_instance;  ///< by index into Scene::instances
};

/// Of one frame of one camera, between its planes. Masks cut nothing out here: what is shared out is where a material
/// is, also where it is not seen. A depth buffer on the CPU, which takes less time than Embree takes to begin.
ViewShares view_shares(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);
