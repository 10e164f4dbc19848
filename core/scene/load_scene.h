#pragma once
#include "core/scene/gltf/load_gltf.h"

#include <filesystem>
#include <vector>

/// Where scenes are looked for, in this order: `extra` (--scene-path), the colon-separated SSRLAB_SCENE_PATH, and
/// ssrlab's own scenes folder.
std::vector<std::filesystem::path> scene_search_path(const std::vector<std::filesystem::path>& extra = {});

/// Names of all folders in the search path that hold a scene.json, sorted, without repetition.
std::vector<std::string> list_scenes(const std::vector<std::filesystem::path>& search_path);

/// Loads what `name` stands for, in this order:
/// - a scene of a family (core/scene/scene_family.h)
/// - a path to a .json, .gltf or .glb file, with its ending in letters of any case
/// - `<folder of the search path>/<name>/scene.json` (keys: scenes/README.md)
/// - the scene.json of the folder `name`
/// A bare glTF gets its own cameras, a default one that sees all of it, and a white environment. `choices` replace
/// those of a scene.json. Fails with Error if something is missing, truncated or malformed, or if there is no animation
/// of the chosen name.
Scene load_scene(const std::string& name, const std::vector<std::filesystem::path>& search_path,
                 const GltfChoices& choices = {});
