#include "core/scene/merge.h"

#include <algorithm>
#include <iterator>

namespace {
template <class T>
void append(std::vector<T>& list, std::vector<T>& more) {
    list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}
}  // namespace

void merge(Scene& scene, Scene other) {
    const auto textures = int(scene.textures.size()), nodes = int(scene.nodes.size());
    const auto materials = unsigned(scene.materials.size()), meshes = unsigned(scene.meshes.size());
    for (Material& material : other.materials)
        for (TextureSlot* slot : {&material.base_color_texture, &material.metalness_roughness_texture,
                                  &material.normal_texture, &material.occlusion_texture, &material.emission_texture})
            if (slot->texture >= 0) slot->texture += textures;
    for (Mesh& mesh : other.meshes) mesh.material += materials;
    for (Node& node : other.nodes)
        if (node.parent >= 0) node.parent += nodes;
    for (Instance& instance : other.instances) instance = {instance.mesh + meshes, instance.node + unsigned(nodes)};
    for (AnimationChannel& channel : other.animation) channel.node += unsigned(nodes);
    for (PunctualLight& light : other.lights)
        if (light.node >= 0) light.node += nodes;
    for (SceneCamera& camera : other.cameras)
        if (camera.node >= 0) camera.node += nodes;
    append(scene.textures, other.textures);
    append(scene.materials, other.materials);
    append(scene.meshes, other.meshes);
    append(scene.nodes, other.nodes);
    append(scene.instances, other.instances);
    append(scene.animation, other.animation);
    append(scene.lights, other.lights);
    append(scene.cameras, other.cameras);
    append(scene.warnings, other.warnings);
    scene.frame_count = std::max(scene.frame_count, other.frame_count);
}
