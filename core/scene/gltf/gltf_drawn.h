#pragma once
#include "core/scene/gltf/gltf_file.h"

/// The nodes at the top of the scene that the file says to show, of its first if it says none, or of all nodes if it
/// has no scenes.
std::vector<int> scene_roots(const GltfFile& file);

/// Of each material whether a mesh of that scene has it, by itself or in one of its variants (KHR_materials_variants).
std::vector<bool> drawn_materials(const GltfFile& file);
