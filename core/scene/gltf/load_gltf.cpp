#include "core/scene/gltf/load_gltf.h"

#include "core/scene/animation.h"
#include "core/scene/content_hash.h"
#include "core/scene/gltf/gltf_parts.h"

#include <map>
#include <set>

void make_names_unique(std::vector<SceneCamera>& cameras) {
    std::set<std::string> taken;
    std::map<std::string, int> count;
    for (SceneCamera& camera : cameras) {
        const std::string name = camera.name;
        int& number = count[name];
        while (!taken.insert(camera.name).second) camera.name = name + "_" + std::to_string(++number + 1);
    }
}

Scene load_gltf(const std::filesystem::path& path) {
    GltfFile file = read_gltf(path);
    Scene scene;
    scene.name = path.stem().string();
    add_materials(file, scene);
    const auto meshes_of = add_meshes(file, scene);
    const auto node_of = add_nodes(file, meshes_of, scene);
    add_animation(file, node_of, scene);
    make_names_unique(scene.cameras);
    scene.frame_count = animation_frames(scene);
    for (SceneCamera& camera : scene.cameras) camera.frame_count = scene.frame_count;
    scene.warnings.assign(file.warnings.begin(), file.warnings.end());
    scene.content_hash = content_hash(scene);
    return scene;
}
