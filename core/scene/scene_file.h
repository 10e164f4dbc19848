#pragma once
#include "core/json.h"
#include "core/scene/gltf/load_gltf.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <vector>

/// Reads a scene.json; its keys are in scenes/README.md. The scene's name is that of the folder. `choices` that are set
/// replace the file's.
Scene load_scene_file(const std::filesystem::path& file, const std::vector<std::filesystem::path>& search_path,
                      GltfChoices choices = {});

/// The last steps of loading: gives a far plane to the glTF's cameras that have none, refuses two cameras of one name,
/// and makes the content hash.
void finish_scene(Scene& scene);

/// A scene file's "environment" (scenes/README.md). An image is looked for beside `file`, then in the search path.
/// `notes` gets a sentence for each conversion.
Environment read_environment(JsonObject object, const std::filesystem::path& file,
                             const std::vector<std::filesystem::path>& search_path, std::vector<std::string>& notes);
