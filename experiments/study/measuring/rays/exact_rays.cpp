#include "experiments/study/measuring/rays/exact_rays.h"

#include "core/error.h"
#include "groundtruth/paths/traced_scene.h"
#include "variants/tracers/outcome.h"

#include <tbb/parallel_for.h>
#include <cmath>

namespace {

struct Met {
    SurfacePoint point;
    glm::vec3 normal;  ///< geometric, to the side that the ray came from
    float distance;
};

/// `camera`: whose ray that is; none: no camera's.
std::optional<Met> meet(const EmbreeScene& scene, glm::vec3 origin, glm::vec3 direction,
                        const CameraView* camera = nullptr) {
    RTCRayHit ray;
    const bool meets = camera ? intersect_from_camera(scene.handle(), *camera, origin, direction, ray)
                              : intersect(scene.handle(), origin, direction, ray);
    if (!meets) return {};
    const SurfacePoint point = scene.point(ray.hit.instID[0], ray.hit.primID, ray.hit.u, ray.hit.v);
    const glm::vec3 normal = glm::dot(point.front_normal, direction) > 0 ? -point.front_normal : point.front_normal;
    return Met{point, normal, glm::length(point.position - origin)};
}

}  // namespace

ExactRays::ExactRays(const Shot& shot, unsigned frame, const CameraData& camera)
    : pose_(shot_frame(shot, frame).camera),
      camera_(camera),
      extent_(shot.config.extent),
      scene_(shot.scene, shot_frame(shot, frame).scene, false),
      view_(pose_, extent_) {
    if (camera.jitter.x != 0 || camera.jitter.y != 0) fail("exact hits are asked for from the centres of pixels only");
}

ExactHit ExactRays::judged(const SurfacePoint& point, glm::vec3 direction, float distance) const {
    const float view_z = (camera_.view_from_world * glm::vec4(point.position, 1.0f)).z;
    if (view_z >= 0) return {.distance = distance, .outcome = outcome_behind_camera};
    const glm::vec4 clip = camera_.clip_from_world * glm::vec4(point.position, 1.0f);
    const glm::vec2 position = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(extent_);
    if (!view_.frames(point.position)) return {position, distance, outcome_off_screen};
    const glm::vec3 to_eye = view_.to_eye(point.position);
    const glm::vec3 normal = glm::dot(point.front_normal, to_eye) < 0 ? -point.front_normal : point.front_normal;
    if (glm::dot(normal, direction) >= 0) return {position, distance, outcome_hidden};  // its other side is seen
    const bool is_hidden = is_hidden_from_camera(scene_.handle(), view_, point.position, point.error, normal);
    return {position, distance, is_hidden ? outcome_hidden : outcome_hit};
}

ExactHit ExactRays::hit(glm::uvec2 pixel, const RayRecord& ray) const {
    const glm::vec3 direction = glm::normalize(glm::mat3(camera_.world_from_view) * ray.direction);
    // A defect may draw no direction at all: not a number, which Embree must not be given.
    if (!std::isfinite(direction.x + direction.y + direction.z)) return {.outcome = outcome_own_surface};
    const CameraRay camera_ray = ::camera_ray(pose_, extent_, glm::vec2(pixel) + 0.5f);
    glm::vec3 origin = glm::vec3(camera_.world_from_view * glm::vec4(ray.origin, 1.0f));
    if (const std::optional<Met> start = meet(scene_, camera_ray.origin, camera_ray.direction, &view_)) {
        if (glm::dot(start->normal, direction) <= 0) return {.outcome = outcome_own_surface};
        origin = offset_origin(start->point.position, start->point.error, start->normal, direction);
    }
    const std::optional<Met> met = meet(scene_, origin, direction);
    if (!met) return {.distance = camera_.depth.y, .outcome = outcome_background};
    return judged(met->point, direction, met->distance);
}

std::vector<ExactHit> ExactRays::hits(const RecordedRays& recorded, unsigned every) const {
    std::vector<ExactHit> hits(recorded.rays.size());
    const size_t per_pixel = recorded.rays_per_pixel;
    tbb::parallel_for(0u, (extent_.y + every - 1) / every, [&](unsigned row) {
        for (glm::uvec2 pixel(0, row * every); pixel.x < extent_.x; pixel.x += every)
            for (size_t number = 0; number < per_pixel; ++number) {
                const size_t i = (size_t(pixel.y) * extent_.x + pixel.x) * per_pixel + number;
                if (recorded.rays[i].is_traced > 0) hits[i] = hit(pixel, recorded.rays[i]);
            }
    });
    return hits;
}
