#include "core/scene/gltf/load_gltf.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/animation.h"
#include "core/scene/content_hash.h"
#include "core/scene/gltf/gltf_deformers.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/unique_names.h"

#include <algorithm>
#include <set>

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
    add_skins(file, node_of, scene);
    add_animation(file, node_of, choices.animation, scene);
    say_what_is_left_out(file, node_of, scene);
    make_names_unique(scene.cameras);
    scene.frame_count = animation_frames(scene);
    for (SceneCamera& camera : scene.cameras) camera.frame_count = scene.frame_count;
    scene.warnings.assign(file.warnings.begin(), file.warnings.end());
    drop_warnings_about_what_is_not_drawn(scene);
    scene.content_hash = content_hash(scene);
    return scene;
}

void check_animation(const Scene& scene, const std::string& animation) {
    if (animation.empty() || animation == "all" || animation == "none") return;
    find_named(scene.clips, animation, "scene '", shortened(scene.name), "' has no animation");
}
