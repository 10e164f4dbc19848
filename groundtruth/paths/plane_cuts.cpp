#include "groundtruth/paths/plane_cuts.h"

#include "groundtruth/paths/traced_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

PlaneCuts count_plane_cuts(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent) {
    const EmbreeScene embree(scene, pose, false);
    const CameraView view(camera, extent);
    const auto count = [&](const tbb::blocked_range<unsigned>& rows, PlaneCuts cuts) {
        for (unsigned y = rows.begin(); y < rows.end(); ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const CameraRay ray = camera_ray(camera, extent, {float(x) + 0.5f, float(y) + 0.5f});
                RTCRayHit hit;
                if (!intersect(embree.handle(), ray.origin, ray.direction, hit)) continue;
                const float depth = hit.ray.tfar * view.cosine(ray.direction);
                cuts.before_near += depth < view.near(), cuts.beyond_far += depth >= view.far();
            }
        return cuts;
    };
    return tbb::parallel_reduce(tbb::blocked_range<unsigned>(0, extent.y), PlaneCuts{}, count,
                                [](const PlaneCuts& a, const PlaneCuts& b) {
                                    return PlaneCuts{a.before_near + b.before_near, a.beyond_far + b.beyond_far};
                                });
}
