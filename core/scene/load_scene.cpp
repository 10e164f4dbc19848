#include "core/scene/load_scene.h"

#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/scene/camera_planes.h"
#include "core/scene/scene_family.h"
#include "core/scene/scene_file.h"
#include "core/scene/unknown_scene.h"

#include <algorithm>
#include <cctype>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

std::vector<fs::path> scene_search_path(const std::vector<fs::path>& extra) {
    std::vector<fs::path> path = extra;
    if (const char* variable = std::getenv("SSRLAB_SCENE_PATH")) {
        std::istringstream folders(variable);
        for (std::string folder; std::getline(folders, folder, ':');)
            if (!folder.empty()) path.emplace_back(folder);
    }
    path.push_back(own_files() / "scenes");
    return path;
}

std::vector<std::string> list_scenes(const std::vector<fs::path>& search_path) {
    std::set<std::string> names;
    for (const fs::path& folder : search_path) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error))
            if (fs::exists(entry.path() / "scene.json")) names.insert(entry.path().filename().string());
    }
    return {names.begin(), names.end()};
}

namespace {

/// A camera before the scene, far enough off to see all of it as it is in frame 0, in images of any shape.
SceneCamera camera_that_sees_all(const Scene& scene) {
    const auto [low, high] = scene_bounds(scene, pose_scene(scene, 0.0f));
    const glm::vec3 center = 0.5f * (low + high);
    const float radius = std::max(0.5f * glm::length(high - low), 1e-6f);
    SceneCamera camera{.name = "default"};
    const float distance = radius / std::sin(0.5f * camera.vertical_fov);
    camera.keys = {{.position = center + glm::normalize(glm::vec3(0.3f, 0.3f, 1.0f)) * distance, .target = center}};
    camera.aspect = 1.0f;
    camera.frame_count = scene.frame_count;
    const CameraPlanes planes = planes_for_all_frames({0.01f * distance, distance + 2.0f * radius}, camera, scene);
    camera.near = planes.near, camera.far = planes.far;
    return camera;
}

Scene load_bare_gltf(const fs::path& file, const GltfChoices& choices) {
    Scene scene = load_gltf(file, choices);
    check_animation(scene, choices.animation);
    scene.draws_backs = false;
    scene.environment = {.type = Environment::Type::constant, .color = glm::vec3(1.0f)};
    if (scene.cameras.empty()) scene.cameras.push_back(camera_that_sees_all(scene));
    finish_scene(scene);
    return scene;
}

}  // namespace

Scene load_scene(const std::string& name, const std::vector<fs::path>& search_path, const GltfChoices& choices) {
    if (name.size() >= PATH_MAX)
        throw UnknownScene("unknown scene '" + shortened(name) + "': the name is too long for a path");
    if (is_of_family(name)) return load_scene_file(scene_file_of_family(name), search_path, choices);
    std::error_code error;  // a name too long for the file system is just unknown
    const fs::path direct = name;
    const std::string ending = lower_case_extension(direct);
    const bool is_scene = ending == ".json", is_gltf = ending == ".gltf" || ending == ".glb";
    const auto load = [&](const fs::path& file) {
        return is_gltf ? load_bare_gltf(file, choices) : load_scene_file(file, search_path, choices);
    };
    if ((is_scene || is_gltf) && fs::exists(direct, error) && !fs::is_directory(direct, error)) return load(direct);
    for (const fs::path& folder : search_path)
        if (!name.empty() && fs::exists(folder / name / "scene.json", error))
            return load_scene_file(folder / name / "scene.json", search_path, choices);
    if (!name.empty() && fs::exists(direct / "scene.json", error))
        return load_scene_file(direct / "scene.json", search_path, choices);
    if (is_scene || is_gltf) return load(direct);  // which says what is wrong with it
    if (!name.empty() && fs::exists(direct, error))
        fail(shortened(name), fs::is_directory(direct, error) ? " is a folder without a scene.json" : " is no scene",
             ": scenes end in .json, .gltf or .glb");
    throw UnknownScene("unknown scene '" + shortened(name) + "'" +
                       suggestion(name, list_scenes(search_path), "ssrlab list scenes"));
}
