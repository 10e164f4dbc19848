#include "core/scene/gltf/tangents.h"

#include "core/scene/transform.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace {
glm::vec3 triangle_normal(const Mesh& mesh, size_t triangle) {
    const auto corner = [&](size_t i) { return mesh.vertices[mesh.indices[triangle * 3 + i]].position; };
    const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    return length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0.0f);
}

/// Per vertex, the index of the first vertex equal to it in position, normal and texture coordinates.
std::vector<uint32_t> weld(const Mesh& mesh, unsigned texcoord) {
    using Key = std::array<float, 8>;
    struct Hash {
        size_t operator()(const Key& key) const {
            return std::hash<std::string_view>{}({reinterpret_cast<const char*>(key.data()), sizeof(Key)});
        }
    };
    std::unordered_map<Key, uint32_t, Hash> first;
    first.reserve(mesh.vertices.size());
    std::vector<uint32_t> welded(mesh.vertices.size());
    for (uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vertex& v = mesh.vertices[i];
        const glm::vec2 uv = v.uv[texcoord];
        Key key = {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z, uv.x, uv.y};
        for (float& value : key) value += 0.0f;  // -0 equals 0, but not their bytes
        welded[i] = first.emplace(key, i).first->second;
    }
    return welded;
}

/// Directions of +u and +v on a triangle, zero where its texture coordinates span no area.
struct Gradient {
    glm::vec3 along_u{0.0f}, along_v{0.0f};
};

Gradient gradient(const Mesh& mesh, size_t triangle, const TextureSlot& slot) {
    const auto vertex = [&](size_t i) -> const Vertex& { return mesh.vertices[mesh.indices[triangle * 3 + i]]; };
    const auto uv = [&](size_t i) {
        return glm::dvec2(slot.uv_transform * glm::vec3(vertex(i).uv[slot.texcoord], 1.0f));
    };
    const glm::dvec3 e1 = glm::dvec3(vertex(1).position) - glm::dvec3(vertex(0).position);
    const glm::dvec3 e2 = glm::dvec3(vertex(2).position) - glm::dvec3(vertex(0).position);
    const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const double area = d1.x * d2.y - d1.y * d2.x;
    if (area == 0.0) return {};
    const double sign = area > 0.0 ? 1.0 : -1.0;
    const auto unit = [](glm::dvec3 v) {
        return glm::length(v) > 0.0 ? glm::vec3(glm::normalize(v)) : glm::vec3(0.0f);
    };
    return {unit(sign * (e1 * d2.y - e2 * d1.y)), unit(sign * (e2 * d1.x - e1 * d2.x))};
}

/// The angle between the triangle's edges at its corner `i`, in the plane of the normal there.
float corner_angle(const Mesh& mesh, size_t triangle, size_t i) {
    const auto vertex = [&](size_t k) -> const Vertex& {
        return mesh.vertices[mesh.indices[triangle * 3 + (i + k) % 3]];
    };
    const glm::vec3 n = vertex(0).normal;
    const auto edge = [&](size_t k) {
        const glm::vec3 e = vertex(k).position - vertex(0).position;
        return direction_or_zero(e - n * glm::dot(n, e));
    };
    return std::acos(std::clamp(glm::dot(edge(1), edge(2)), -1.0f, 1.0f));
}

/// Sums of tangents at one welded vertex, for handedness -1 and +1.
struct TangentSums {
    glm::vec3 sum[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
};

enum Handedness : uint8_t { left, right, undetermined };
}  // namespace

void make_flat_normals(Mesh& mesh) {
    std::vector<Vertex> vertices(mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        vertices[i] = mesh.vertices[mesh.indices[i]];
        vertices[i].normal = triangle_normal(mesh, i / 3);
        if (vertices[i].normal == glm::vec3(0.0f)) vertices[i].normal = {0.0f, 1.0f, 0.0f};  // no area: never seen
    }
    mesh.vertices = std::move(vertices);
    for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = uint32_t(i);
}

void repair_normals(Mesh& mesh) {
    for (Vertex& vertex : mesh.vertices) vertex.normal = direction_or_zero(vertex.normal);
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        Vertex& vertex = mesh.vertices[mesh.indices[i]];
        if (vertex.normal == glm::vec3(0.0f)) vertex.normal = triangle_normal(mesh, i / 3);
    }
    for (Vertex& vertex : mesh.vertices)
        if (vertex.normal == glm::vec3(0.0f)) vertex.normal = {0.0f, 1.0f, 0.0f};
}

void derive_tangents(Mesh& mesh, const TextureSlot& slot) {
    const std::vector<uint32_t> welded = weld(mesh, slot.texcoord);
    std::vector<TangentSums> sums(mesh.vertices.size());
    std::vector<Handedness> handedness(mesh.indices.size(), undetermined);
    for (size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        const Gradient directions = gradient(mesh, triangle, slot);
        if (directions.along_u == glm::vec3(0.0f)) continue;
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t index = mesh.indices[triangle * 3 + i];
            const glm::vec3 n = mesh.vertices[index].normal;
            const bool is_right = glm::dot(glm::cross(n, directions.along_u), directions.along_v) < 0.0f;
            handedness[triangle * 3 + i] = is_right ? right : left;
            const glm::vec3 t = direction_or_zero(directions.along_u - n * glm::dot(n, directions.along_u));
            sums[welded[index]].sum[is_right] += t * corner_angle(mesh, triangle, i);
        }
    }

    const size_t count = mesh.vertices.size();
    std::vector<uint32_t> copy(count, UINT32_MAX);  // of the vertices that were split: the right-handed one
    std::vector<Handedness> taken(count, undetermined);
    const auto set_tangent = [&](uint32_t at, uint32_t from, Handedness hand) {
        const glm::vec3 n = mesh.vertices[at].normal;
        const glm::vec3 t = direction_or_zero(sums[welded[from]].sum[hand]);
        mesh.vertices[at].tangent =
            glm::vec4(t == glm::vec3(0.0f) ? any_perpendicular(n) : t, hand == right ? 1.0f : -1.0f);
    };
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t index = mesh.indices[i];
        if (handedness[i] == undetermined) continue;  // takes what the others at this vertex agree on
        if (taken[index] == undetermined) {
            taken[index] = handedness[i];
            set_tangent(index, index, handedness[i]);
        } else if (taken[index] != handedness[i]) {
            if (copy[index] == UINT32_MAX) {
                copy[index] = uint32_t(mesh.vertices.size());
                mesh.vertices.push_back(Vertex(mesh.vertices[index]));
                set_tangent(copy[index], index, handedness[i]);
            }
            mesh.indices[i] = copy[index];
        }
    }
    for (uint32_t index = 0; index < count; ++index) {
        if (taken[index] != undetermined) continue;
        const TangentSums& sum = sums[welded[index]];
        set_tangent(index, index,
                    glm::dot(sum.sum[left], sum.sum[left]) > glm::dot(sum.sum[right], sum.sum[right]) ? left : right);
    }
}

void make_any_tangents(Mesh& mesh) {
    for (Vertex& vertex : mesh.vertices) vertex.tangent = glm::vec4(any_perpendicular(vertex.normal), 1.0f);
}

void repair_tangents(Mesh& mesh) {
    for (Vertex& vertex : mesh.vertices) {
        const glm::vec3 along_u = direction_or_zero(glm::vec3(vertex.tangent));
        const glm::vec3 t = direction_or_zero(along_u - vertex.normal * glm::dot(vertex.normal, along_u));
        vertex.tangent = glm::vec4(t == glm::vec3(0.0f) ? any_perpendicular(vertex.normal) : t,
                                   vertex.tangent.w < 0.0f ? -1.0f : 1.0f);
    }
}

bool turns_tangents(const glm::mat3& m) {
    return m[0][1] != 0.0f || m[1][0] != 0.0f || !(m[0][0] > 0.0f) || !(m[1][1] > 0.0f);
}

void turn_tangents(Mesh& mesh, const TextureSlot& slot) {
    if (!turns_tangents(slot.uv_transform)) return;
    MemoryShare copies;
    copies.add(2.0 * (double(mesh.vertices.size()) * sizeof(Vertex) + double(mesh.indices.size()) * sizeof(uint32_t)),
               "mesh '" + mesh.name + "' while its tangents are turned");
    Mesh before = mesh, after = mesh;
    derive_tangents(before, {.texture = slot.texture, .texcoord = slot.texcoord});
    derive_tangents(after, slot);
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        const glm::vec3 n = mesh.vertices[i].normal;
        const glm::vec4 from = before.vertices[i].tangent, to = after.vertices[i].tangent;
        const auto in_frame_of = [&](glm::vec3 along_u, glm::vec3 v) {
            return glm::vec2(glm::dot(along_u, v), glm::dot(glm::cross(n, along_u), v));
        };
        const glm::vec2 turn = in_frame_of(from, to);
        glm::vec4& tangent = mesh.vertices[i].tangent;
        const glm::vec3 along_u(tangent);
        tangent = glm::vec4(turn.x * along_u + turn.y * glm::cross(n, along_u), tangent.w * from.w * to.w);
    }
    repair_tangents(mesh);
}

void finish_normals(Mesh& mesh, bool has_tangents, const TextureSlot& normal_texture) {
    if (mesh.is_flat_shaded)
        make_flat_normals(mesh);
    else
        repair_normals(mesh);
    if (normal_texture.texture < 0)
        make_any_tangents(mesh);
    else if (has_tangents && !mesh.is_flat_shaded)
        repair_tangents(mesh), turn_tangents(mesh, normal_texture);
    else
        derive_tangents(mesh, normal_texture);
}
