#pragma once
#include "core/scene/gltf/gltf_file.h"
#include "core/scene/scene.h"

#include <map>

// The steps of load_gltf(), in order. Each appends to the scene what one part of the file says, and to file.warnings
// what it leaves out.

/// Materials in the file's order, then one default material (glTF 2.0, section 3.9.6) for primitives without any.
void add_materials(GltfFile& file, Scene& scene);

/// One Mesh per triangle primitive. Returns, per glTF mesh, the indices of its meshes.
std::vector<std::vector<unsigned>> add_meshes(GltfFile& file, Scene& scene);

/// The nodes of the file's scene, parents first, with their instances, lights and cameras. Returns the index of each
/// glTF node among Scene::nodes, -1 for those outside the scene.
std::vector<int> add_nodes(GltfFile& file, const std::vector<std::vector<unsigned>>& meshes_of, Scene& scene);

/// The channels of all animations; several animations play at once, as they do in glTF viewers by default.
void add_animation(GltfFile& file, const std::vector<int>& node_of, Scene& scene);
