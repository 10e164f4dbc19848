#pragma once
#include "core/scene/scene.h"

#include <filesystem>

/// What a glTF file leaves to its user.
struct GltfChoices {
    std::string material_variant;       ///< one of KHR_materials_variants; "": the file's default materials
    bool draws_blended_opaque = false;  ///< alphaMode BLEND is opaque; else it is cut where alpha is below 0.5
    /// Name of an animation (unnamed ones are "animation_0" by their index), "all" or "none". With "all" the last
    /// animation counts if several move the same property. If the file has none of that name: all, as parts of one
    /// motion, if no two move the same property of a node, else the first; a warning says which.
    std::string animation;

    bool operator==(const GltfChoices&) const = default;
};

/// A glTF 2.0 file (.gltf or .glb): meshes, skins, materials, nodes, animation, lights, cameras. Fails with Error if
/// something is missing, truncated or malformed, or if it has no such variant.
Scene load_gltf(const std::filesystem::path& file, const GltfChoices& choices = {});

/// Fails with Error, which has a near miss, if the scene's files have no animation of that name; "", "all" and "none"
/// are always there.
void check_animation(const Scene& scene, const std::string& animation);
