#include "core/scene/gltf/gltf_drawn.h"

namespace {

/// Meshes of the nodes that can be reached from the scene's.
std::vector<bool> drawn_meshes(const GltfFile& file) {
    const auto& nodes = file.model.nodes;
    std::vector<bool> is_drawn(file.model.meshes.size(), false), is_reached(nodes.size(), false);
    std::vector<int> open = scene_roots(file);
    while (!open.empty()) {
        const int index = open.back();
        open.pop_back();
        if (index < 0 || size_t(index) >= nodes.size() || is_reached[size_t(index)]) continue;  // add_nodes() says so
        is_reached[size_t(index)] = true;
        const tinygltf::Node& node = nodes[size_t(index)];
        if (node.mesh >= 0 && size_t(node.mesh) < is_drawn.size()) is_drawn[size_t(node.mesh)] = true;
        open.insert(open.end(), node.children.begin(), node.children.end());
    }
    return is_drawn;
}

std::vector<int> materials_of(const tinygltf::Primitive& primitive) {
    std::vector<int> materials = {primitive.material};
    const auto variants = primitive.extensions.find("KHR_materials_variants");
    if (variants == primitive.extensions.end() || !variants->second.Has("mappings")) return materials;
    const tinygltf::Value& mappings = variants->second.Get("mappings");
    for (size_t i = 0; i < mappings.ArrayLen(); ++i)
        if (const tinygltf::Value& mapping = mappings.Get(int(i)); mapping.IsObject() && mapping.Has("material"))
            materials.push_back(mapping.Get("material").GetNumberAsInt());
    return materials;
}
}  // namespace

std::vector<int> scene_roots(const GltfFile& file) {
    const auto& model = file.model;
    if (!model.scenes.empty()) {
        const int shown = model.defaultScene < 0 ? 0 : model.defaultScene;
        return model.scenes[checked_index(file, shown, model.scenes.size(), "scene")].nodes;
    }
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const auto& node : model.nodes)
        for (const int child : node.children)
            is_child[checked_index(file, child, model.nodes.size(), "child node")] = true;
    std::vector<int> found;
    for (size_t i = 0; i < model.nodes.size(); ++i)
        if (!is_child[i]) found.push_back(int(i));
    return found;
}

std::vector<bool> drawn_materials(const GltfFile& file) {
    const std::vector<bool> is_mesh_drawn = drawn_meshes(file);
    std::vector<bool> is_drawn(file.model.materials.size(), false);
    for (size_t mesh = 0; mesh < is_mesh_drawn.size(); ++mesh) {
        if (!is_mesh_drawn[mesh]) continue;
        for (const tinygltf::Primitive& primitive : file.model.meshes[mesh].primitives)
            for (const int material : materials_of(primitive))
                if (material >= 0 && size_t(material) < is_drawn.size()) is_drawn[size_t(material)] = true;
    }
    return is_drawn;
}
