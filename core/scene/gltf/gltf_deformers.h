#pragma once
#include "core/scene/gltf/gltf_file.h"

// What deforms a mesh: its morph targets (glTF 2.0, section 3.7.2.2) and the joints that its vertices follow (3.7.3.3).

/// A primitive whose Mesh is read, except what deforms it.
struct ReadPrimitive {
    const GltfFile& file;
    const tinygltf::Primitive& primitive;
    const Mesh&
        as_in_file;     ///< before normals and tangents are made; that splits vertices but keeps the order of corners
    bool has_tangents;  ///< the file's
    const std::string& what;  ///< "mesh 2 primitive 0"
};

/// Whether the primitive has morph targets or joints.
bool deforms_vertices(const tinygltf::Primitive& primitive);

/// Bytes per vertex of its Mesh, beside the Vertex.
double deformation_bytes(const tinygltf::Primitive& primitive);

/// Whether the attribute is one of the joint sets that are read: JOINTS_n and WEIGHTS_n from 0 on, both of each.
bool is_of_joints(const tinygltf::Primitive& primitive, const std::string& attribute);

/// Sets mesh.targets and mesh.joint_weights. `warning` gets the faults of weights that were repaired.
void add_deformers(const ReadPrimitive& from, const TextureSlot& normal_texture, Mesh& mesh, std::string& warning);

/// Warns of what morph targets move and ssrlab does not.
void warn_of_targets(GltfFile& file, size_t mesh, size_t primitive);

/// The number of morph targets of a mesh; fails if its primitives differ.
size_t target_count(const GltfFile& file, size_t mesh);

/// Adds the skins of the scene's instances, which so far name the file's skins, and memory for what deforms. An
/// instance whose mesh has no joint weights loses its skin, with a warning. `node_of`: as add_nodes() returns it.
void add_skins(GltfFile& file, const std::vector<int>& node_of, Scene& scene);
