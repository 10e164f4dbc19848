#pragma once
#include "core/scene/scene.h"

#include <span>

/// Whether joints or morph targets move the vertices of an instance.
bool deforms(const Scene& scene, const Instance& instance);

/// The vertices of an instance's mesh at a pose; pose.world_from_instance moves them to the world. They are the mesh's
/// own, or lie in `deformed` if joints or morph targets move them: morph targets come first, then joints (glTF 2.0,
/// sections 3.7.2.2 and 3.7.3.2). Normals have unit length, or none where a joint flattens them, and tangents are unit
/// and perpendicular to them. Fails with Error if a position leaves +-any_length (ranges.h).
std::span<const Vertex> posed_vertices(const Scene& scene, const ScenePose& pose, size_t instance,
                                       std::vector<Vertex>& deformed);

/// Sets pose.deformations, and world_from_instance of skinned instances. `nodes`: as animated; pose.world_from_node is
/// theirs.
void add_deformations(const Scene& scene, const std::vector<Node>& nodes, ScenePose& pose);

/// The scene with a mesh of its own for each instance that joints or morph targets deform, of its vertices at the pose;
/// pose.world_from_instance moves these as all others. `storage` holds it, unless nothing is deformed: then it is
/// `scene`.
const Scene& with_posed_meshes(const Scene& scene, const ScenePose& pose, Scene& storage);
