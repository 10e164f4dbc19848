#pragma once
#include "core/scene/scene.h"
#include "experiments/study/config/config.h"
#include "groundtruth/reference/reference.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// What another program needs to render what ssrlab's G-buffer holds (experiments/README.md, "Scenes for other
/// programs"): geometry, materials, poses, and the light that reflections are to be computed from.

/// Programs by what they can read.
enum class SceneFormat {
    gltf,  ///< scene.glb, light and environment as EXR, environment also as Radiance HDR
    raw    ///< these, and for programs that read neither: scene.meshes.json, textures as PNG, light as raw floats
};

struct SceneEngine {
    std::string name, about;
    SceneFormat format = SceneFormat::gltf;
};
const std::vector<SceneEngine>& scene_engines();

struct SceneFolderSettings {
    SceneEngine engine;
    std::string scene;
    GltfChoices choices;               ///< in place of the scene's own
    std::vector<std::string> cameras;  ///< empty: the scene's first
    glm::uvec2 extent{480, 270};
    std::vector<unsigned> frames{0};  ///< ascending
    ReferenceSettings reference;      ///< of the light
    bool has_probe = false;  ///< a probe at the first camera takes the environment's place (reflection_probe.h)
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

/// Writes the folder; files of other views there stay. Its light is the reference's without reflections, under the
/// key that a study with the same samples looks for. Fails with Error where scene or camera are unknown.
SceneFolder write_scene_folder(const SceneFolderSettings& settings);
