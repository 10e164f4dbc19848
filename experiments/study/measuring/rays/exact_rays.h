#pragma once
#include "core/ray_probe.h"
#include "core/scene/scene.h"
#include "core/shared/camera.h"
#include "experiments/study/config/shots/shot.h"
#include "groundtruth/scene/camera_view.h"
#include "groundtruth/scene/embree_scene.h"

/// True hits in the scene of rays that start from a frame's pixels.
class ExactRays {
public:
    /// `camera`: of the frame's G-buffer, without jitter. `shot` must outlive this.
    ExactRays(const Shot& shot, unsigned frame, const CameraData& camera);

    /// True hits, in the order of the rays. Only pixels at every `every`-th place along each axis are asked for; rays
    /// of other pixels, and rays that were not traced, get a hit without meaning.
    ///
    /// Rays start where the pixel's camera ray meets the scene, as the G-buffer knows this place only to its depth's
    /// precision. They keep the technique's direction; a direction that is not a number hits nothing
    /// (outcome_own_surface). A point is shown if it lies within the image, on the side that faces the camera, and
    /// nothing hides it. Visibility is tested for points, as in the truth ladder, not for pixels.
    std::vector<ExactHit> hits(const RecordedRays& recorded, unsigned every = 1) const;

private:
    ExactHit hit(glm::uvec2 pixel, const RayRecord& ray) const;
    ExactHit judged(const SurfacePoint& point, glm::vec3 direction, float distance) const;

    CameraPose pose_;
    CameraData camera_;
    glm::uvec2 extent_;
    EmbreeScene scene_;
    CameraView view_;
};
