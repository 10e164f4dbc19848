#pragma once
#include "core/scene/scene.h"

/// A mesh in which each triangle begins with a vertex that begins no other triangle. This vertex carries the triangle's
/// values, as Vulkan takes flat values from the first vertex. Triangles are rotated, keeping their winding; vertices
/// are repeated where rotation does not help.
struct LeadingVertices {
    std::vector<uint32_t> source;   ///< per vertex: its index in the mesh
    std::vector<uint32_t> indices;  ///< three per triangle, the leading vertex first
    std::vector<glm::vec3>
        triangle_normal;  ///< per vertex: the unit normal of the triangle it leads, in object space; 0 if none
    std::vector<float> triangle_alpha;  ///< per vertex: alpha that the three colours of its triangle share; -1: they
                                        ///< differ, or no triangle
};

/// The unit normal, computed in double precision for long thin triangles. Zero for triangles without area.
glm::vec3 triangle_normal(glm::vec3 a, glm::vec3 b, glm::vec3 c);

/// Covers all triangles of the mesh, in their order.
LeadingVertices find_leading_vertices(const Mesh& mesh);
