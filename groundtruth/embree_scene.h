#pragma once
#include "core/scene/scene.h"

#include <embree3/rtcore.h>
#include <memory>
#include <vector>

/// What shading reads of a triangle, side by side so that a hit costs two cache lines. The order of the corners makes
/// cross(p1 - p0, p2 - p0) point to the front, also under transforms of negative determinant.
struct alignas(64) TriangleRecord {
    glm::vec3 position[3];
    glm::vec3 normal[3];     ///< unit
    glm::vec3 front_normal;  ///< unit geometric normal
    glm::vec2 uv[3];      ///< texcoord 0
    uint32_t corner[3];   ///< vertices of the mesh, for its rarer attributes
};

/// How the records of an instance are placed. Baked geometry is in world space already.
struct InstanceRecord {
    const TriangleRecord* triangles = nullptr;
    const Mesh* mesh = nullptr;
    uint32_t material = 0;
    bool is_baked = true;
    bool is_mirrored = false;       ///< negative determinant
    glm::mat4 world_from_object{1.0f};
    glm::mat3 normal_matrix{1.0f};  ///< inverse transpose
};

/// A point on a surface in world space, from barycentrics: it is closer to the triangle than origin + t direction.
struct SurfacePoint {
    glm::vec3 position, error;   ///< m; `error` is the half extent of a box that holds the exact point
    glm::vec3 front_normal;      ///< unit geometric normal of the front side
    glm::vec3 normal;            ///< unit interpolated vertex normal
    glm::vec2 uv;                ///< texcoord 0
};

/// Embree's view of one frame: a mesh drawn once is baked into the top level, one drawn more often becomes a BVH of its own.
class EmbreeScene {
public:
    /// Geometry ids are indices of Scene::instances. Fails with MachineError if Embree cannot build it.
    EmbreeScene(const Scene& scene, const ScenePose& pose, bool test_every_alpha);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene handle() const { return scene_; }
    const InstanceRecord& instance(uint32_t index) const { return instances_[index]; }
    bool has_alpha_tests() const { return !alpha_tests_.empty(); }

    SurfacePoint point(uint32_t instance, uint32_t triangle, float u, float v) const;

private:
    struct AlphaTest;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::vector<std::vector<TriangleRecord>> triangles_;  ///< per mesh, or per baked instance
    std::vector<InstanceRecord> instances_;
    std::vector<std::unique_ptr<AlphaTest>> alpha_tests_;
    std::vector<RTCScene> mesh_scenes_;

    RTCGeometry make_triangles(const std::vector<TriangleRecord>& records, const Scene& scene, const Mesh& mesh, bool test_every_alpha);
    static void test_alpha(const RTCFilterFunctionNArguments* arguments);
};

/// `position` moved out of its error box along the normal, to the side of `direction` (Pharr, Jakob and Humphreys 2016,
/// "Physically Based Rendering", section 3.9.5).
glm::vec3 offset_origin(glm::vec3 position, glm::vec3 error, glm::vec3 normal, glm::vec3 direction);
