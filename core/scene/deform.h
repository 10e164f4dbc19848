#pragma once
#include "core/scene/scene.h"

#include <span>

/// Whether joints or morph targets move the vertices of an instance.
bool deforms(const Scene& scene, const Instance& instance);

/// The vertices of an instance's mesh at a pose; pose.world_from_instance moves them to the world. They are the mesh's
/// own, or lie in `deformed` if morph targets, then joints, move them (glTF 2.0, sections 3.7.2.2 and 3.7.3.2). Normals
/// are unit, or zero where a joint flattens them; tangents are unit and perpendicular to normals. Fails with Error if a
/// position leaves +-any_length (ranges.h).
std::span<const Vertex> posed_vertices(const Scene& scene, const ScenePose& pose, size_t instance,
                                       std::vector<Vertex>& deformed);

/// Sets pose.deformations, and world_from_instance of skinned instances. `nodes`: as animated, with
/// pose.world_from_node.
void add_deformations(const Scene& scene, const std::vector<Node>& nodes, ScenePose& pose);

/// The scene with a posed mesh of its own for each instance that joints or morph targets deform;
/// pose.world_from_instance moves these as all others. The result is `storage`, or `scene` if nothing is deformed.
const Scene& with_posed_meshes(const Scene& scene, const ScenePose& pose, Scene& storage);
