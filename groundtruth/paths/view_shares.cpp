#include "groundtruth/paths/view_shares.h"

#include "groundtruth/paths/traced_scene.h"
#include "groundtruth/sampling/flush_denormals.h"

#include <tbb/parallel_for.h>

ViewShares view_shares(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent) {
    constexpr uint32_t nothing = ~0u;
    const EmbreeScene embree(scene, pose, false);
    std::vector<uint32_t> shown(size_t(extent.x) * extent.y, nothing);
    tbb::parallel_for(0u, extent.y, [&](unsigned y) {
        const FlushDenormals flush;
        for (unsigned x = 0; x < extent.x; ++x) {
            const CameraRay view = camera_ray(camera, extent, {float(x) + 0.5f, float(y) + 0.5f});
            RTCRayHit ray;
            if (intersect(embree.handle(), view.origin, view.direction, ray))
                shown[size_t(y) * extent.x + x] = ray.hit.instID[0];
        }
    });
    ViewShares shares{.of_material = std::vector<double>(scene.materials.size()),
                      .of_instance = std::vector<double>(scene.instances.size())};
    const double pixel = 1.0 / double(shown.size());
    for (const uint32_t instance : shown) {
        if (instance == nothing) continue;
        shares.of_instance[instance] += pixel;
        shares.of_material[embree.instance(instance).material] += pixel;
    }
    return shares;
}
