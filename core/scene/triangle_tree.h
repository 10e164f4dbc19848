#pragma once
#include "core/scene/instance_bounds.h"
#include "core/scene/scene.h"

#include <span>

/// The distance (m) of a mesh's nearest point from a point in world space, by one pass over all triangles.
double nearest_distance(const std::vector<uint32_t>& indices, std::span<const Vertex> vertices,
                        const glm::mat4& world_from_mesh, glm::vec3 point);
inline double nearest_distance(const Mesh& mesh, const glm::mat4& world_from_mesh, glm::vec3 point) {
    return nearest_distance(mesh.indices, mesh.vertices, world_from_mesh, point);
}

/// A tree of boxes over a mesh's triangles, for many queries of distances.
class TriangleTree {
public:
    /// `mesh` must outlive this.
    explicit TriangleTree(const Mesh& mesh);

    /// The same bits as nearest_distance() where that is below `limit`, else `limit`.
    double nearest(const glm::mat4& world_from_mesh, glm::vec3 point, double limit) const;

private:
    struct Node {
        Box box;
        uint32_t first = 0, count = 0;  ///< of triangles_, if a leaf
        uint32_t second_child = 0;      ///< the first one follows its parent; 0: a leaf
    };
    uint32_t build(uint32_t first, uint32_t count, const std::vector<Box>& boxes);

    const Mesh& mesh_;
    std::vector<uint32_t> triangles_;
    std::vector<Node> nodes_;
};
