#pragma once
#include "core/scene/scene.h"
#include "experiments/study/config/config.h"
#include "groundtruth/reference/reference.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// The files from which another program renders what ssrlab's G-buffer holds (experiments/docs/judge.md): geometry,
/// materials, poses, and the light that reflections show.

/// Formats that programs read.
enum class SceneFormat {
    gltf,  ///< scene.glb, light and environment as EXR, environment also as Radiance HDR
    raw    ///< those of gltf, and scene.meshes.json, textures as PNG, light as raw floats
};

struct SceneEngine {
    std::string name, about;
    SceneFormat format = SceneFormat::gltf;
};
const std::vector<SceneEngine>& scene_engines();

struct SceneFolderSettings {
    SceneEngine engine;
    std::string scene;
    GltfChoices choices;               ///< override the scene's own
    std::vector<std::string> cameras;  ///< empty: the scene's first
    glm::uvec2 extent{480, 270};
    std::vector<unsigned> frames{0};   ///< ascending
    ReferenceSettings reference;       ///< settings of the light's references
    bool has_probe = false;            ///< a probe at the first camera replaces the environment (reflection_probe.h)
    std::filesystem::path out, cache;  ///< cache: of references
    std::vector<std::filesystem::path> search_path;
    std::function<void(const std::string&)> say;                        ///< gets sentences for the user
    std::function<void(double share, const std::string& what)> report;  ///< of references that are rendered
};

struct SceneFolder {
    std::vector<std::string> views;
    std::vector<std::string> warnings;
    size_t rendered = 0, cached = 0;  ///< references
};

/// Writes the folder; files of other views in it stay. The light is the reference's without reflections, cached under
/// the key of a study with the same samples. Fails with Error if scene or camera is unknown.
SceneFolder write_scene_folder(const SceneFolderSettings& settings);
