#pragma once
#include "core/scene/scene.h"

#include <filesystem>

/// What a glTF file leaves to its user.
struct GltfChoices {
    std::string material_variant;  ///< one of KHR_materials_variants; "": the materials that the file shows without
    bool draws_blended_opaque = false;  ///< alphaMode BLEND; else it is cut where alpha is below 0.5
    /// One of its animations, of which unnamed ones are called "animation_0" by their index; or "all", of which the
    /// last one counts where several move the same; or "none". If the file has none of that name, all are played where
    /// no two move the same property of a node, since they are parts of one motion then, else the first; a warning says
    /// which.
    std::string animation;

    bool operator==(const GltfChoices&) const = default;
};

/// A glTF 2.0 file (.gltf or .glb): meshes, skins, materials, nodes, animation, lights, cameras. Fails with Error if
/// something is missing, truncated or malformed, or if it has no such variant.
Scene load_gltf(const std::filesystem::path& file, const GltfChoices& choices = {});

/// Fails with Error, which has a near miss, if the scene's files have no animation of that name; "", "all" and "none"
/// are always there.
void check_animation(const Scene& scene, const std::string& animation);
