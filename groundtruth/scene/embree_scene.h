#pragma once
#include "core/scene/scene.h"
#include "groundtruth/sampling/prefetch.h"

#include <embree3/rtcore.h>
#include <cmath>
#include <memory>
#include <vector>

/// The data of a triangle that shading reads, in two cache lines. The order of the corners makes cross(p1 - p0, p2 -
/// p0) point to the front, also under transforms of negative determinant.
struct alignas(64) TriangleRecord {
    glm::vec3 position[3];
    glm::vec3 normal[3];     ///< as the normal matrix gives it; normalised after interpolation, as in the rasteriser
    glm::vec3 front_normal;  ///< unit geometric normal
    uint32_t corner[3];      ///< vertices of the mesh, for its other attributes
};

/// How the records of an instance are placed. Baked geometry is in world space already.
struct InstanceRecord {
    const TriangleRecord* triangles = nullptr;
    const Mesh* mesh = nullptr;
    const Vertex* vertices = nullptr;  ///< the mesh's, as posed
    uint32_t material = 0;
    bool is_baked = true;
    bool is_mirrored = false;  ///< see NormalTransform
    glm::mat4 world_from_object{1.0f};
    glm::mat3 normal_matrix{1.0f};  ///< see NormalTransform
};

/// A point on a surface in world space. It comes from barycentrics, which are closer to the triangle than origin + t
/// direction.
struct SurfacePoint {
    glm::vec3 position, error;  ///< m; `error` is the half extent of a box that holds the exact point
    glm::vec3 front_normal;     ///< unit geometric normal of the front side
    glm::vec3 normal;           ///< interpolated vertex normal, of any length
};

/// At which end of a ray the viewer is; RTCRay::id holds it. If a scene hides backs, a ray from a point to the eye
/// stops only at surfaces that face the eye.
enum class Viewer : unsigned { at_origin, at_end };

/// Embree's view of one frame. A mesh drawn once is baked into the top level; a mesh drawn more often gets its own BVH.
/// Embree moves rays into an instance by the inverse of its transform: instances without an inverse are baked, too, and
/// so are instances that joints or morph targets deform.
class EmbreeScene {
public:
    /// Geometry ids are indices of Scene::instances. Fails with MachineError if Embree cannot build it.
    EmbreeScene(const Scene& scene, const ScenePose& pose, bool test_every_alpha);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene handle() const { return scene_; }
    const InstanceRecord& instance(uint32_t index) const { return instances_[index]; }
    bool has_alpha_tests() const { return has_alpha_tests_; }
    bool hides_backs() const { return hides_backs_; }  ///< of any surface

    /// The point of a hit. `u`, `v`: barycentrics of the second and the third corner, as Embree gives them.
    SurfacePoint point(uint32_t instance, uint32_t triangle, float u, float v) const;
    void prefetch(uint32_t instance, uint32_t triangle) const {
        const char* record = reinterpret_cast<const char*>(&instances_[instance].triangles[triangle]);
        prefetch_line(record);
        prefetch_line(record + 64);
    }

private:
    struct HitTest;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::vector<std::vector<TriangleRecord>> triangles_;  ///< of each mesh, then of each baked instance
    std::vector<InstanceRecord> instances_;
    std::vector<std::vector<Vertex>> deformed_;  ///< of each deformed instance
    std::vector<std::unique_ptr<HitTest>> hit_tests_;
    bool has_alpha_tests_ = false, hides_backs_ = false;
    std::vector<RTCScene> mesh_scenes_;

    void place(const InstanceRecord& instance, SurfacePoint& point) const;
    RTCGeometry make_triangles(const std::vector<TriangleRecord>& records, const Scene& scene, const Mesh& mesh,
                               bool test_every_alpha);
    static void test_hit(const RTCFilterFunctionNArguments* arguments);
};

/// Bound of the relative error of n float operations in a row (Higham 2002, section 3.1).
constexpr float rounding_bound(int n) { return float(n) * 0x1p-24f / (1.0f - float(n) * 0x1p-24f); }

/// step_back() moves a point by its error times this: enough if the ray is inclined to the surface by more than asin(1
/// / step_back_errors), 7 degrees.
inline constexpr float step_back_errors = 8.0f;

/// glm::abs without its branches.
inline glm::vec3 magnitude(glm::vec3 v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

inline SurfacePoint EmbreeScene::point(uint32_t instance_index, uint32_t triangle, float u, float v) const {
    const InstanceRecord& instance = instances_[instance_index];
    const TriangleRecord& record = instance.triangles[triangle];
    const float w = 1.0f - u - v;
    const glm::vec3 p0 = w * record.position[0], p1 = u * record.position[1], p2 = v * record.position[2];
    SurfacePoint point{p0 + p1 + p2, rounding_bound(7) * (magnitude(p0) + magnitude(p1) + magnitude(p2)),
                       record.front_normal, w * record.normal[0] + u * record.normal[1] + v * record.normal[2]};
    if (!instance.is_baked) place(instance, point);
    return point;
}

/// A unit vector along an interpolated normal, or `fallback` where there is none. Branchless, for vector loops.
inline glm::vec3 unit_normal(glm::vec3 normal, glm::vec3 fallback) {
    const float square = glm::dot(normal, normal), scale = 1.0f / std::sqrt(square);
    const bool is_known = square > 0.0f;
    return {is_known ? normal.x * scale : fallback.x, is_known ? normal.y * scale : fallback.y,
            is_known ? normal.z * scale : fallback.z};
}

/// `position` stepped back along its ray, towards `view` (unit), by the uncertainty of its place along the surface. The
/// rounding errors of its barycentrics grow with the length `distance` (m) of the ray. At a concave edge they may put
/// it behind the other surface, from where the next ray would leave the scene; the ray's way is known to be free. The
/// step is at most half that way.
inline glm::vec3 step_back(glm::vec3 position, glm::vec3 error, glm::vec3 view, float distance) {
    const float step = step_back_errors * (error.x + error.y + error.z + rounding_bound(7) * distance);
    return position + view * (step < 0.5f * distance ? step : 0.5f * distance);
}

/// `position` moved out of its error box along the normal, to the side of `direction` (Pharr, Jakob and Humphreys 2016,
/// "Physically Based Rendering", section 3.9.5). Rounding must not undo the offset, and a point on a plane through the
/// origin has no error at all: one more step of the float grid, and a little that counts only at zero, see to both.
inline glm::vec3 offset_origin(glm::vec3 position, glm::vec3 error, glm::vec3 normal, glm::vec3 direction) {
    const glm::vec3 size = magnitude(normal) * error;
    const float side = glm::dot(normal, direction) < 0 ? -1.0f : 1.0f;
    const glm::vec3 outward = side * normal;
    const glm::vec3 origin = position + (size.x + size.y + size.z) * outward;
    const glm::vec3 step = magnitude(origin) * 0x1p-23f + 1e-20f;
    return {origin.x + (outward.x > 0   ? step.x
                        : outward.x < 0 ? -step.x
                                        : 0.0f),
            origin.y + (outward.y > 0   ? step.y
                        : outward.y < 0 ? -step.y
                                        : 0.0f),
            origin.z + (outward.z > 0   ? step.z
                        : outward.z < 0 ? -step.z
                                        : 0.0f)};
}
