#pragma once
#include "core/scene/gltf/gltf_file.h"
#include "core/scene/gltf/load_gltf.h"
#include "core/scene/scene.h"

// The steps of load_gltf(), in order. Each appends to the scene what one part of the file says, and to file.warnings
// what it leaves out.

/// Materials in the file's order, then one default material (glTF 2.0, section 3.9.6) for primitives without any.
void add_materials(GltfFile& file, Scene& scene);

/// One Mesh per triangle primitive, with the material of the chosen variant. Returns, per glTF mesh, the indices of its
/// meshes.
std::vector<std::vector<unsigned>> add_meshes(GltfFile& file, Scene& scene, const GltfChoices& choices);

/// The index of a variant of KHR_materials_variants; -1 for "". Fails with Error, which lists the file's variants, if
/// the name is unknown.
int find_material_variant(const GltfFile& file, const std::string& name);

/// The glTF material of a primitive under that variant; -1: the default one.
int material_of(const tinygltf::Primitive& primitive, int variant);

/// Turns blended materials (alphaMode BLEND) into masks that cut below 0.5: a G-buffer has one layer. Materials whose
/// alpha is 1 everywhere, or that `choices` draw opaque, become opaque.
void cut_blended_materials(GltfFile& file, Scene& scene, const GltfChoices& choices);

/// The nodes of the file's scene, parents first, with their instances, lights and cameras. Returns the index of each
/// glTF node among Scene::nodes, -1 for those outside the scene. Instances name the file's skins until add_skins().
std::vector<int> add_nodes(GltfFile& file, const std::vector<std::vector<unsigned>>& meshes_of, Scene& scene);

/// The copies of EXT_mesh_gpu_instancing: a node below `node` for each, which draws `meshes`. Returns whether the glTF
/// node has that extension.
bool add_mesh_copies(const GltfFile& file, const tinygltf::Node& source, const std::vector<unsigned>& meshes,
                     unsigned node, const std::string& what, Scene& scene);

/// Warns of ignored parts that change the picture, beside materials, meshes and nodes: animated properties other than
/// those of nodes, light of images, units of lights.
void say_what_is_left_out(GltfFile& file, const std::vector<int>& node_of, const Scene& scene);

/// Adds the clips, and the channels of played clips (load_gltf.h).
void add_animation(GltfFile& file, const std::vector<int>& node_of, const std::string& wanted, Scene& scene);
