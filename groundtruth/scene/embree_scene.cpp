#include "groundtruth/scene/embree_scene.h"

#include "core/error.h"
#include "core/memory_fault.h"
#include "core/scene/deform.h"
#include "core/scene/transform.h"
#include "groundtruth/scene/alpha_mask.h"
#include "groundtruth/scene/embree_device.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {

glm::mat3 absolute(const glm::mat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

/// Triangles of a mesh with the instance's vertices, moved by `world_from_object`; mirrored ones swap two corners to
/// keep their front.
std::vector<TriangleRecord> make_records(const Mesh& mesh, const InstanceRecord& instance) {
    std::vector<TriangleRecord> records(mesh.indices.size() / 3);
    tbb::parallel_for(size_t(0), records.size(), [&](size_t t) {
        TriangleRecord& record = records[t];
        for (int k = 0; k < 3; ++k) {
            const int corner = instance.is_mirrored && k > 0 ? 3 - k : k;
            const uint32_t index = mesh.indices[3 * t + corner];
            const Vertex& vertex = instance.vertices[index];
            record.corner[k] = index;
            record.position[k] = glm::vec3(instance.world_from_object * glm::vec4(vertex.position, 1.0f));
            record.normal[k] = instance.normal_matrix * vertex.normal;
        }
        const glm::dvec3 p0(record.position[0]), p1(record.position[1]), p2(record.position[2]);
        const glm::dvec3 normal = glm::cross(p1 - p0, p2 - p0);
        const double length = glm::length(normal);
        record.front_normal = length > 0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
    });
    return records;
}

}  // namespace

/// What the intersection filter of one geometry reads. Geometries without a mask and with backs have none: a filter
/// takes Embree out of its own code at every hit.
struct EmbreeScene::HitTest {
    const std::vector<TriangleRecord>* records;
    const Mesh* mesh;
    const Material* material;
    const Texture* texture;  ///< nullptr: none
    bool hides_back;
};

void EmbreeScene::test_hit(const RTCFilterFunctionNArguments* arguments) {
    const HitTest& test = *static_cast<const HitTest*>(arguments->geometryUserPtr);
    if (arguments->valid[0] != -1) return;
    if (test.hides_back) {
        // Both in the space of the mesh, whose front is the front of its instances, mirrored or not.
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, 0),
                                  RTCRayN_dir_y(arguments->ray, arguments->N, 0),
                                  RTCRayN_dir_z(arguments->ray, arguments->N, 0)),
            front(RTCHitN_Ng_x(arguments->hit, arguments->N, 0), RTCHitN_Ng_y(arguments->hit, arguments->N, 0),
                  RTCHitN_Ng_z(arguments->hit, arguments->N, 0));
        const bool is_along = glm::dot(direction, front) > 0;
        const bool is_back = is_along == (RTCRayN_id(arguments->ray, arguments->N, 0) == unsigned(Viewer::at_origin));
        if (is_back) {
            arguments->valid[0] = 0;
            return;
        }
    }
    const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    const float u = RTCHitN_u(arguments->hit, arguments->N, 0), v = RTCHitN_v(arguments->hit, arguments->N, 0);
    if (is_cut_out(*test.material, test.texture, *test.mesh, (*test.records)[triangle].corner, u, v))
        arguments->valid[0] = 0;
}

RTCGeometry EmbreeScene::make_triangles(const std::vector<TriangleRecord>& records, const Scene& scene,
                                        const Mesh& mesh, bool test_every_alpha) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), std::max<size_t>(1, mesh.vertices.size())));
    auto* indices =
        static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       3 * sizeof(uint32_t), std::max<size_t>(1, records.size())));
    if (!positions || !indices) fail_machine(memory_sentence(" for Embree to take over mesh '" + mesh.name + "'"));
    for (size_t t = 0; t < records.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const uint32_t corner = records[t].corner[k];
            indices[3 * t + k] = corner;
            for (int axis = 0; axis < 3; ++axis) positions[3 * size_t(corner) + axis] = records[t].position[k][axis];
        }
    if (records.empty()) std::fill_n(indices, 3, 0u), std::fill_n(positions, 3, 0.0f);

    const Material& material = scene.materials[mesh.material];
    const bool has_alpha_test = material.alpha_mode == AlphaMode::mask || test_every_alpha,
               hides_back = scene.hides_backs_of(material);
    has_alpha_tests_ |= has_alpha_test, hides_backs_ |= hides_back;
    if (has_alpha_test || hides_back) {
        const int texture = material.base_color_texture.texture;
        hit_tests_.push_back(std::make_unique<HitTest>(
            HitTest{&records, &mesh, &material, texture < 0 ? nullptr : &scene.textures[size_t(texture)], hides_back}));
        rtcSetGeometryUserData(geometry, hit_tests_.back().get());
        rtcSetGeometryIntersectFilterFunction(geometry, test_hit);
        rtcSetGeometryOccludedFilterFunction(geometry, test_hit);
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

EmbreeScene::EmbreeScene(const Scene& scene, const ScenePose& pose, bool test_every_alpha) {
    device_ = open_embree();
    const auto new_scene = [&] {
        RTCScene result = rtcNewScene(device_);
        rtcSetSceneFlags(result, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(result, RTC_BUILD_QUALITY_HIGH);
        return result;
    };
    const auto attach = [](RTCScene target, RTCGeometry geometry, unsigned id) {
        rtcAttachGeometryByID(target, geometry, id);
        rtcReleaseGeometry(geometry);
    };

    std::vector<unsigned> use_count(scene.meshes.size(), 0);
    for (const Instance& instance : scene.instances) ++use_count[instance.mesh];

    scene_ = new_scene();
    instances_.resize(scene.instances.size());
    deformed_.resize(scene.instances.size());
    triangles_.resize(scene.meshes.size() + scene.instances.size());
    mesh_scenes_.resize(scene.meshes.size(), nullptr);
    for (unsigned i = 0; i < scene.instances.size(); ++i) {
        const unsigned mesh_index = scene.instances[i].mesh;
        const Mesh& mesh = scene.meshes[mesh_index];
        const glm::mat4& transform = pose.world_from_instance[i];
        InstanceRecord& record = instances_[i];
        record.mesh = &mesh;
        record.vertices = posed_vertices(scene, pose, i, deformed_[i]).data();
        record.material = mesh.material;
        record.world_from_object = transform;
        const NormalTransform normals = normal_transform(transform);
        record.normal_matrix = normals.matrix;
        record.is_mirrored = normals.is_mirrored;
        record.is_baked = use_count[mesh_index] == 1 || normals.is_flat || !deformed_[i].empty();

        std::vector<TriangleRecord>& triangles = triangles_[record.is_baked ? scene.meshes.size() + i : mesh_index];
        if (record.is_baked) {
            triangles = make_records(mesh, record);
            attach(scene_, make_triangles(triangles, scene, mesh, test_every_alpha), i);
        } else {
            if (!mesh_scenes_[mesh_index]) {
                triangles = make_records(mesh, InstanceRecord{.vertices = mesh.vertices.data()});
                mesh_scenes_[mesh_index] = new_scene();
                attach(mesh_scenes_[mesh_index], make_triangles(triangles, scene, mesh, test_every_alpha), 0);
                rtcCommitScene(mesh_scenes_[mesh_index]);
            }
            RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, mesh_scenes_[mesh_index]);
            rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform);
            rtcCommitGeometry(geometry);
            attach(scene_, geometry, i);
        }
        record.triangles = triangles.data();
    }
    rtcCommitScene(scene_);
    if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
        fail_machine(embree_sentence(error, message_text("build the BVH of scene '", scene.name, "' with ",
                                                         scene.triangle_count(), " triangles")));
}

EmbreeScene::~EmbreeScene() {
    for (RTCScene mesh_scene : mesh_scenes_)
        if (mesh_scene) rtcReleaseScene(mesh_scene);
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
}

/// Moves a point of an instanced mesh from the space of the mesh to the world.
void EmbreeScene::place(const InstanceRecord& instance, SurfacePoint& point) const {
    const glm::mat3 linear(instance.world_from_object);
    const glm::vec3 translation(instance.world_from_object[3]), local = point.position;
    point.position = linear * local + translation;
    // Embree meets the instance in its own space, to which it moves each ray with rounding errors of the same size.
    point.error = absolute(linear) * point.error +
                  2.0f * rounding_bound(4) *
                      (absolute(linear) * glm::abs(local) + glm::abs(translation) + glm::abs(point.position));
    point.normal = instance.normal_matrix * point.normal;
    point.front_normal = glm::normalize(instance.normal_matrix * point.front_normal);
}
