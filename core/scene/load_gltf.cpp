#include "core/scene/animation.h"
#include "core/scene/content_hash.h"
#include "core/scene/gltf_parts.h"
#include "core/scene/load_scene.h"

Scene load_gltf(const std::filesystem::path& path) {
    GltfFile file = read_gltf(path);
    Scene scene;
    scene.name = path.stem().string();
    add_materials(file, scene);
    const auto meshes_of = add_meshes(file, scene);
    const auto node_of = add_nodes(file, meshes_of, scene);
    add_animation(file, node_of, scene);
    scene.frame_count = animation_frames(scene);
    scene.warnings.assign(file.warnings.begin(), file.warnings.end());
    scene.content_hash = content_hash(scene);
    return scene;
}
