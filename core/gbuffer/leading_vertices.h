#pragma once
#include "core/scene/scene.h"

/// A mesh whose triangles each begin with a vertex that begins no other triangle, so that this vertex can carry what
/// belongs to the triangle: Vulkan takes flat values from the first vertex. Triangles are turned, keeping their
/// winding, and vertices are repeated where turning does not help.
struct LeadingVertices {
    std::vector<uint32_t> source;   ///< per vertex: its index in the mesh
    std::vector<uint32_t> indices;  ///< three per triangle, the leading vertex first
    std::vector<glm::vec3>
        triangle_normal;  ///< per vertex: the unit normal of the triangle it leads, in object space; 0 if none
    std::vector<float> triangle_alpha;  ///< per vertex: what the three colours of that triangle have as alpha; -1: they
                                        ///< differ, or none
};

/// Unit, in double precision: long thin triangles lose theirs otherwise. Zero for triangles without area.
glm::vec3 triangle_normal(glm::vec3 a, glm::vec3 b, glm::vec3 c);

/// Of all triangles of the mesh, in their order.
LeadingVertices find_leading_vertices(const Mesh& mesh);
