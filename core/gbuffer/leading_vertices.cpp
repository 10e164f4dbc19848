#include "core/gbuffer/leading_vertices.h"

#include <numeric>

glm::vec3 triangle_normal(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::dvec3 p(a);
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - p, glm::dvec3(c) - p);
    const double length = glm::length(n);
    return length > 0 ? glm::vec3(n / length) : glm::vec3(0);
}

namespace {

/// Of the corners' colours, if they have one alpha, else -1.
float common_alpha(const Mesh& mesh, const uint32_t* corner) {
    const float alpha = mesh.vertices[corner[0]].color.a;
    return mesh.vertices[corner[1]].color.a == alpha && mesh.vertices[corner[2]].color.a == alpha ? alpha : -1.0f;
}

}  // namespace

LeadingVertices find_leading_vertices(const Mesh& mesh) {
    LeadingVertices result;
    result.source.resize(mesh.vertices.size());
    std::iota(result.source.begin(), result.source.end(), 0u);
    result.triangle_normal.resize(mesh.vertices.size(), glm::vec3(0));
    result.triangle_alpha.resize(mesh.vertices.size(), -1.0f);
    std::vector<bool> leads(mesh.vertices.size(), false);

    for (size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
        const uint32_t* corner = &mesh.indices[first];
        unsigned turn = 0;
        while (turn < 3 && leads[corner[turn]]) ++turn;
        uint32_t leader = turn < 3 ? corner[turn] : uint32_t(result.source.size());
        if (turn == 3) {
            turn = 0;
            result.source.push_back(corner[0]);
            result.triangle_normal.emplace_back(0);
            result.triangle_alpha.emplace_back(-1.0f);
        } else {
            leads[leader] = true;
        }
        result.triangle_normal[leader] = triangle_normal(
            mesh.vertices[corner[0]].position, mesh.vertices[corner[1]].position, mesh.vertices[corner[2]].position);
        result.triangle_alpha[leader] = common_alpha(mesh, corner);
        result.indices.insert(result.indices.end(), {leader, corner[(turn + 1) % 3], corner[(turn + 2) % 3]});
    }
    return result;
}
