#include "groundtruth/paths/mirror_rays.h"

#include "core/shared/brdf.h"
#include "groundtruth/paths/traced_scene.h"
#include "groundtruth/sampling/lobes.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace {

struct Hit {
    SurfacePoint point;
    ShadedPoint surface;
    const Material* material;
};

class MirrorRays {
public:
    MirrorRays(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent, bool reads_maps)
        : scene_(scene),
          embree_(scene, pose, false),
          materials_(scene, embree_, false),
          camera_(camera),
          view_(camera, extent),
          extent_(extent),
          clip_from_world_(clip_from_view(camera, float(extent.x) / float(extent.y), DepthDirection::standard) *
                           glm::inverse(camera.world_from_view)),
          reads_maps_(reads_maps) {}

    MirrorRayShares trace() {
        for (unsigned y = 0; y < extent_.y; ++y)
            for (unsigned x = 0; x < extent_.x; ++x) {
                const CameraRay view = camera_ray(camera_, extent_, {float(x) + 0.5f, float(y) + 0.5f});
                const std::optional<Hit> hit = seen_hit(view.origin, view.direction);
                if (hit && is_reflective(*hit)) count(view, *hit);
            }
        MirrorRayShares shares = counts_;
        shares.reflective /= double(extent_.x) * extent_.y;
        for (double* share : {&shares.seen, &shares.hidden, &shares.off, &shares.behind, &shares.sky, &shares.thin})
            *share /= std::max(1.0, counts_.reflective);
        shares.roughness = median(roughnesses_), shares.reflectance = median(reflectances_);
        return shares;
    }

private:
    std::optional<Hit> first_hit(glm::vec3 origin, glm::vec3 direction) const {
        RTCRayHit ray;
        if (!intersect(embree_.handle(), origin, direction, ray)) return {};
        return shaded(ray, direction);
    }

    /// Of a ray of the camera.
    std::optional<Hit> seen_hit(glm::vec3 origin, glm::vec3 direction) const {
        RTCRayHit ray;
        if (!intersect_from_camera(embree_.handle(), view_, origin, direction, ray)) return {};
        return shaded(ray, direction);
    }

    Hit shaded(const RTCRayHit& ray, glm::vec3 direction) const {
        const unsigned instance = ray.hit.instID[0];
        Hit hit{embree_.point(instance, ray.hit.primID, ray.hit.u, ray.hit.v),
                {},
                &scene_.materials[embree_.instance(instance).material]};
        materials_.shade(instance, ray.hit.primID, ray.hit.u, ray.hit.v, -direction, ray.ray.tfar,
                         [&](const ShadedPoint& surface) { hit.surface = surface; });
        return hit;
    }

    bool is_reflective(const Hit& hit) const {
        if (reads_maps_) return hit.surface.specular > 0 && hit.surface.roughness <= reflective_roughness;
        return hit.material->roughness <= reflective_roughness && hit.material->metalness_roughness_texture.texture < 0;
    }

    /// Where the camera's ray to `point` starts.
    glm::vec3 eye_of(glm::vec3 point) const {
        return camera_.is_orthographic ? point + view_.to_eye(point) : view_.eye();
    }

    /// The camera's own ray ends within 0.2 % of the distance of `point`.
    bool is_seen(glm::vec3 point) const {
        const glm::vec3 eye = eye_of(point);
        const float distance = glm::distance(eye, point);
        const std::optional<Hit> hit = seen_hit(eye, (point - eye) / distance);
        return !hit || glm::distance(eye, hit->point.position) > 0.998f * distance;
    }

    bool is_between_planes(glm::vec3 point) const {
        const float depth = view_.depth(point);
        return depth >= view_.near() && depth < view_.far();
    }

    /// Behind what the camera sees at `hit` follows another surface soon.
    bool is_thin(const Hit& hit) const {
        const glm::vec3 direction = glm::normalize(hit.point.position - eye_of(hit.point.position));
        const glm::vec3 origin = offset_origin(hit.point.position, hit.point.error, hit.point.front_normal, direction);
        const std::optional<Hit> back = first_hit(origin, direction);
        return back && glm::distance(back->point.position, origin) <= thin_thickness;
    }

    void count(const CameraRay& view, const Hit& first) {
        ++counts_.reflective;
        roughnesses_.push_back(first.surface.roughness);
        const ShadedPoint& surface = first.surface;
        reflectances_.push_back(
            luminance(specular_f0(surface.base_color, surface.metalness, surface.specular, surface.dielectric_f0)));

        const glm::vec3 normal = first.point.front_normal, direction = glm::reflect(view.direction, normal);
        const glm::vec3 origin = offset_origin(first.point.position, first.point.error, normal, direction);
        const std::optional<Hit> second = first_hit(origin, direction);
        if (!second) {
            ++counts_.sky;
            return;
        }
        const glm::vec4 clip = clip_from_world_ * glm::vec4(second->point.position, 1.0f);
        if (clip.w <= 0.0f)
            ++counts_.behind;
        else if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w || !is_between_planes(second->point.position))
            ++counts_.off;
        else if (is_seen(second->point.position)) {
            ++counts_.seen;
            if (is_thin(*second)) ++counts_.thin;
        } else
            ++counts_.hidden;
    }

    static double median(std::vector<float>& values) {
        if (values.empty()) return 0;
        const auto middle = values.begin() + long(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    const Scene& scene_;
    EmbreeScene embree_;
    MaterialTable materials_;
    CameraPose camera_;
    CameraView view_;
    glm::uvec2 extent_;
    glm::mat4 clip_from_world_;
    bool reads_maps_;
    MirrorRayShares counts_;
    std::vector<float> roughnesses_, reflectances_;
};

}  // namespace

MirrorRayShares trace_mirror_rays(const Scene& scene, const ScenePose& pose, const CameraPose& camera,
                                  glm::uvec2 extent, bool reads_maps) {
    return MirrorRays(scene, pose, camera, extent, reads_maps).trace();
}
