#pragma once
#include "core/scene/gltf/gltf_file.h"

/// The top nodes of the scene that the file says to show, else of its first scene, else of all nodes.
std::vector<int> scene_roots(const GltfFile& file);

/// For each material, whether a mesh of that scene has it, directly or in a variant (KHR_materials_variants).
std::vector<bool> drawn_materials(const GltfFile& file);
