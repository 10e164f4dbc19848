#include "core/scene/deform.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/ranges.h"
#include "core/scene/transform.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace {

/// Vertices that one task moves: some 10 us of work.
constexpr size_t vertices_per_task = 1024;

using Range = tbb::blocked_range<size_t>;

void add_target(const MorphTarget& target, float weight, const Range& range, std::vector<Vertex>& vertices) {
    if (!target.positions.empty())
        for (size_t i = range.begin(); i < range.end(); ++i) vertices[i].position += weight * target.positions[i];
    if (!target.normals.empty())
        for (size_t i = range.begin(); i < range.end(); ++i) vertices[i].normal += weight * target.normals[i];
    if (!target.tangents.empty())
        for (size_t i = range.begin(); i < range.end(); ++i)
            vertices[i].tangent += glm::vec4(weight * target.tangents[i], 0.0f);
}

/// 1 over the largest number of the joints' linear parts, by which products of three of them neither overflow nor
/// vanish.
float inverse_of_largest(const std::vector<glm::mat4>& joints) {
    float largest = 0.0f;
    for (const glm::mat4& joint : joints)
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(joint[column][row]));
    return largest > 0.0f ? 1.0f / largest : 0.0f;
}

/// The inverse transpose but for a positive factor, as NormalTransform::matrix, in float32: there is one for each
/// vertex.
glm::mat3 moves_normals(const glm::mat3& m) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0.0f ? -cofactors : cofactors;
}

/// direction_or_zero(), at once where squares of float32 do.
glm::vec3 unit(glm::vec3 v) {
    const float square = glm::dot(v, v);
    return square > 1e-20f && square < 1e20f ? v * (1.0f / std::sqrt(square)) : direction_or_zero(v);
}

void follow_joints(const Mesh& mesh, const std::vector<glm::mat4>& joints, const Range& range, float normal_scale,
                   std::vector<Vertex>& vertices) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
        const JointWeight* followed = &mesh.joint_weights[i * mesh.joints_per_vertex];
        glm::mat4 blended = followed[0].weight * joints[followed[0].joint];
        for (unsigned k = 1; k < mesh.joints_per_vertex && followed[k].weight > 0.0f; ++k)
            blended += followed[k].weight * joints[followed[k].joint];
        Vertex& vertex = vertices[i];
        const glm::mat3 linear(blended);
        vertex.position = linear * vertex.position + glm::vec3(blended[3]);
        vertex.normal = moves_normals(normal_scale * linear) * vertex.normal;
        vertex.tangent = glm::vec4(linear * glm::vec3(vertex.tangent), vertex.tangent.w);
    }
}

/// Any tangents where no normal map reads them.
void make_orthonormal(const Range& range, bool has_normal_map, std::vector<Vertex>& vertices) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
        Vertex& vertex = vertices[i];
        const glm::vec3 normal = vertex.normal = unit(vertex.normal);
        glm::vec3 tangent(0.0f);
        if (has_normal_map) {
            const glm::vec3 along = unit(glm::vec3(vertex.tangent));
            tangent = unit(along - normal * glm::dot(normal, along));
        }
        vertex.tangent = glm::vec4(tangent == glm::vec3(0.0f) ? any_perpendicular(normal) : tangent, vertex.tangent.w);
    }
}

/// Of the vertices of these triangles, which no other triangle uses.
void set_flat_normals(const Mesh& mesh, const Range& triangles, std::vector<Vertex>& vertices) {
    for (size_t t = triangles.begin(); t < triangles.end(); ++t) {
        const uint32_t* corner = &mesh.indices[3 * t];
        const glm::dvec3 p(vertices[corner[0]].position);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(vertices[corner[1]].position) - p, glm::dvec3(vertices[corner[2]].position) - p);
        const double length = glm::length(normal);
        for (int k = 0; k < 3; ++k)
            vertices[corner[k]].normal = length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

bool is_in_range(const Range& range, const std::vector<Vertex>& vertices) {
    bool all = true;
    for (size_t i = range.begin(); i < range.end(); ++i)
        for (int axis = 0; axis < 3; ++axis) all &= std::abs(vertices[i].position[axis]) <= any_length;
    return all;
}

/// False if a position leaves +-any_length.
bool deform(const Mesh& mesh, const Deformation& by, bool has_normal_map, std::vector<Vertex>& vertices) {
    vertices.resize(mesh.vertices.size());
    const float normal_scale = inverse_of_largest(by.instance_from_mesh);
    std::atomic<bool> is_everywhere_in_range = true;
    tbb::parallel_for(Range(0, vertices.size(), vertices_per_task), [&](const Range& range) {
        const auto first = std::ptrdiff_t(range.begin()), end = std::ptrdiff_t(range.end());
        std::copy(mesh.vertices.begin() + first, mesh.vertices.begin() + end, vertices.begin() + first);
        for (size_t t = 0; t < by.weights.size(); ++t)
            if (by.weights[t] != 0.0f) add_target(mesh.targets[t], by.weights[t], range, vertices);
        if (!by.instance_from_mesh.empty()) follow_joints(mesh, by.instance_from_mesh, range, normal_scale, vertices);
        if (!mesh.is_flat_shaded) make_orthonormal(range, has_normal_map, vertices);
        if (!is_in_range(range, vertices)) is_everywhere_in_range = false;
    });
    if (!mesh.is_flat_shaded || !is_everywhere_in_range) return is_everywhere_in_range;
    tbb::parallel_for(Range(0, mesh.indices.size() / 3, vertices_per_task),
                      [&](const Range& triangles) { set_flat_normals(mesh, triangles, vertices); });
    tbb::parallel_for(Range(0, vertices.size(), vertices_per_task),
                      [&](const Range& range) { make_orthonormal(range, has_normal_map, vertices); });
    return true;
}

/// A mesh of these vertices that nothing deforms.
Mesh rigid_mesh(const Mesh& mesh, std::vector<Vertex> vertices) {
    return {.name = mesh.name, .vertices = std::move(vertices), .indices = mesh.indices, .material = mesh.material};
}

}  // namespace

bool deforms(const Scene& scene, const Instance& instance) {
    return instance.skin >= 0 || !scene.meshes[instance.mesh].targets.empty();
}

std::span<const Vertex> posed_vertices(const Scene& scene, const ScenePose& pose, size_t instance,
                                       std::vector<Vertex>& deformed) {
    const Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
    if (pose.deformations.empty() || pose.deformations[instance] == Deformation{}) return mesh.vertices;
    const bool has_normal_map = scene.materials[mesh.material].normal_texture.texture >= 0;
    if (!deform(mesh, pose.deformations[instance], has_normal_map, deformed))
        fail("scene '", scene.name, "': joints or morph targets move vertices of mesh '", shortened(mesh.name),
             "' (node '", shortened(scene.nodes[scene.instances[instance].node].name), "') beyond +-", any_length,
             " m");
    return deformed;
}

void add_deformations(const Scene& scene, const std::vector<Node>& nodes, ScenePose& pose) {
    const auto is_deformed = [&](const Instance& instance) { return deforms(scene, instance); };
    if (std::ranges::none_of(scene.instances, is_deformed)) return;
    pose.deformations.resize(scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        Deformation& deformation = pose.deformations[i];
        if (!scene.meshes[instance.mesh].targets.empty())
            deformation.weights =
                nodes[instance.weights_node < 0 ? instance.node : size_t(instance.weights_node)].weights;
        if (instance.skin < 0) continue;
        const Skin& skin = scene.skins[size_t(instance.skin)];
        for (size_t j = 0; j < skin.joints.size(); ++j)
            deformation.instance_from_mesh.emplace_back(glm::dmat4(pose.world_from_node[skin.joints[j]]) *
                                                        glm::dmat4(skin.joint_from_mesh[j]));
        // Joints that mirror turn the triangles' winding. The instance gets the mirroring, so that its front stays its
        // front as below a node that mirrors (section 3.7.4).
        pose.world_from_instance[i] = glm::mat4(1.0f);
        if (!(glm::determinant(glm::dmat3(deformation.instance_from_mesh[0])) < 0.0)) continue;
        pose.world_from_instance[i][0][0] = -1.0f;
        for (glm::mat4& matrix : deformation.instance_from_mesh)
            for (int column = 0; column < 4; ++column) matrix[column][0] = -matrix[column][0];
    }
}

const Scene& with_posed_meshes(const Scene& scene, const ScenePose& pose, Scene& storage) {
    if (pose.deformations.empty()) return scene;
    storage = scene;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        if (!deforms(scene, scene.instances[i])) continue;
        std::vector<Vertex> vertices;
        posed_vertices(scene, pose, i, vertices);
        Instance& instance = storage.instances[i];
        instance = {.mesh = unsigned(storage.meshes.size()), .node = instance.node};
        storage.meshes.push_back(rigid_mesh(scene.meshes[scene.instances[i].mesh], std::move(vertices)));
    }
    return storage;
}
