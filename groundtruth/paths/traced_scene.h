#pragma once
#include "groundtruth/lights/light_sampler.h"
#include "groundtruth/paths/expected_radiance.h"
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/sampling/lobes.h"
#include "groundtruth/scene/camera_view.h"

#include <limits>

/// All data of one frame that paths read: geometry, materials, lights, settings, and the camera's view.
struct TracedScene {
    const Scene& scene;
    CameraView camera;
    PathTracerSettings settings;
    MisHeuristic mis;
    EmbreeScene geometry;
    MaterialTable materials;
    LightSampler lights;
    bool has_environment;  ///< an environment that is not black
    ExpectedRadiance expected;

    TracedScene(const Scene& scene, const ScenePose& pose, const CameraView& camera,
                const PathTracerSettings& settings);
};

/// Parts that the scene does not need, so that they are not traced or evaluated; none with
/// PathTracerSettings::keep_all.
std::vector<LeftOut> left_out_features(const TracedScene& traced);

inline constexpr float infinite_distance = std::numeric_limits<float>::infinity();

/// The nearest hit beyond `near` (in units of `direction`). On a hit, instID[0] is the index of the instance, baked or
/// not.
inline bool intersect(RTCScene scene, glm::vec3 origin, glm::vec3 direction, RTCRayHit& ray, float near = 0.0f) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    ray.ray = {origin.x,
               origin.y,
               origin.z,
               near,
               direction.x,
               direction.y,
               direction.z,
               0.0f,
               infinite_distance,
               ~0u,
               unsigned(Viewer::at_origin),
               0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    if (ray.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) ray.hit.instID[0] = ray.hit.geomID;
    return true;
}

/// Whether anything stands between `near` and `far` (in units of `direction`).
inline bool is_occluded(RTCScene scene, glm::vec3 origin, glm::vec3 direction, float far, float near = 0.0f,
                        Viewer viewer = Viewer::at_origin) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{origin.x,    origin.y, origin.z, near, direction.x,      direction.y,
               direction.z, 0.0f,     far,      ~0u,  unsigned(viewer), 0};
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
}

/// The nearest surface between the camera's planes along a camera ray (camera_ray()). Only camera rays know the planes:
/// reflections and shadows ignore them.
inline bool intersect_from_camera(RTCScene scene, const CameraView& camera, glm::vec3 origin, glm::vec3 direction,
                                  RTCRayHit& ray) {
    const float cosine = camera.cosine(direction);
    if (!intersect(scene, origin, direction, ray)) return false;
    const bool is_cut = ray.ray.tfar * cosine < camera.near();
    if (is_cut && !intersect(scene, origin, direction, ray, camera.near() / cosine)) return false;
    return ray.ray.tfar * cosine < camera.far();  // on the plane it is no nearer than the depth buffer's clear value
}

/// Whether something between the camera's near plane and a point hides the point. `error`, `normal`: of the point,
/// which camera.frames() contains; `normal` is on the side of the eye.
inline bool is_hidden_from_camera(RTCScene scene, const CameraView& camera, glm::vec3 position, glm::vec3 error,
                                  glm::vec3 normal) {
    const glm::vec3 to_eye = camera.to_eye(position);
    const glm::vec3 origin = offset_origin(position, error, normal, to_eye), direction = position + to_eye - origin;
    const float depth = camera.depth(origin);
    const float far = depth > camera.near() ? 1.0f - camera.near() / depth : 0.0f;
    return is_occluded(scene, origin, direction, far, 0.0f, Viewer::at_end);
}

/// Relative error of a point on a ray between two points: the roundings of the difference, its product with t and the
/// sum, and as many in Embree's distance to a plane.
inline constexpr float shadow_ray_rounding = rounding_bound(6);

/// Aims a shadow ray from a point to the light of a lane, offset at both ends. At the light's end the ray's rounding
/// errors, which grow with the coordinates of both ends, add to the light's. A punctual light may lie in a surface that
/// must not hide it, so the ray ends before all these errors. Branchless, for vector loops.
inline void aim_shadow_ray(glm::vec3 position, glm::vec3 error, glm::vec3 normal, int lane, LightLanes& lights) {
    const glm::vec3 direction = lights.direction.get(lane);
    const glm::vec3 origin = offset_origin(position, error, normal, direction);
    const glm::vec3 light = lights.position.get(lane);
    const glm::vec3 rounding = shadow_ray_rounding * (magnitude(origin) + magnitude(light));
    const glm::vec3 target =
        offset_origin(light, lights.error.get(lane) + rounding, lights.normal.get(lane), -direction);
    const glm::vec3 to_target = target - origin;
    const float far = 1.0f - (rounding.x + rounding.y + rounding.z) / std::sqrt(glm::dot(to_target, to_target));
    const bool is_infinite = lights.is_infinite[lane] != 0;
    lights.shadow_origin.set(lane, origin);
    lights.shadow_direction.set(lane, choose(is_infinite, direction, to_target));
    lights.shadow_far[lane] = is_infinite ? infinite_distance : far > 0.0f ? far : 0.0f;
}

/// Whether the light of a lane reaches the point that aim_shadow_ray() was given.
inline bool is_visible(const TracedScene& scene, const LightLanes& lights, int lane, PixelEstimate& estimate) {
    const glm::vec3 origin = lights.shadow_origin.get(lane), direction = lights.shadow_direction.get(lane);
    ++estimate.rays;
    return !is_occluded(scene.geometry.handle(), origin, direction, lights.shadow_far[lane]);
}

/// Whether the image of the camera shows a point on the side that `normal` (unit, geometric) points to.
bool is_on_screen(const TracedScene& scene, glm::vec3 position, glm::vec3 error, glm::vec3 normal,
                  PixelEstimate& estimate);
/// Whether the image shows the environment in a direction (unit).
bool is_on_screen(const TracedScene& scene, glm::vec3 direction, PixelEstimate& estimate);
