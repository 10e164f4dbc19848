#pragma once
#include "core/ray_probe.h"
#include "core/scene/scene.h"
#include "core/shared/camera.h"
#include "experiments/study/config/shots/shot.h"
#include "groundtruth/scene/camera_view.h"
#include "groundtruth/scene/embree_scene.h"

/// What rays that start from the pixels of one frame meet in the scene.
class ExactRays {
public:
    /// `camera`: of the frame's G-buffer, without jitter. `shot` must outlive this.
    ExactRays(const Shot& shot, unsigned frame, const CameraData& camera);

    /// In the order of the rays; of those that were not traced, or not asked for, a hit without meaning. Asked for is
    /// one pixel in `every` along each axis. Rays start where the pixel's camera ray meets the scene, which the
    /// G-buffer knows to the precision of its depth only. They go as the technique drew them; one
    /// whose direction is not a number meets nothing (outcome_own_surface). A point is shown if it
    /// lies within the image, on the side that faces the camera, and nothing hides it: that of points, as in the truth
    /// ladder, not of pixels.
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
