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

namespace {
/// A material that no instance has changes nothing.
void drop_warnings_about_what_is_not_drawn(Scene& scene) {
    std::set<int> drawn;
    for (const Instance& instance : scene.instances) drawn.insert(int(scene.meshes[instance.mesh].material));
    std::erase_if(scene.warnings,
                  [&](const SceneWarning& w) { return w.material >= 0 && !drawn.contains(w.material); });
}
}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfChoices& choices) {
    GltfFile file = read_gltf(path);
    Scene scene;
    scene.name = path.stem().string();
    add_materials(file, scene);
    const auto meshes_of = add_meshes(file, scene, choices);
    cut_blended_materials(file, scene, choices);
    const auto node_of = add_nodes(file, meshes_of, scene);
    add_animation(file, node_of, scene);
    say_what_is_left_out(file, node_of, scene);
    make_names_unique(scene.cameras);
    scene.frame_count = animation_frames(scene);
    for (SceneCamera& camera : scene.cameras) camera.frame_count = scene.frame_count;
    scene.warnings.assign(file.warnings.begin(), file.warnings.end());
    drop_warnings_about_what_is_not_drawn(scene);
    scene.content_hash = content_hash(scene);
    return scene;
}
