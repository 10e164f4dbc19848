#include "core/near_miss.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/gltf_value.h"

#include <algorithm>
#include <charconv>

namespace {
/// The index after `list` in a JSON pointer such as "/materials/2/emissiveFactor"; -1 if it begins otherwise.
int index_in_pointer(const std::string& pointer, const std::string& list) {
    if (!pointer.starts_with(list)) return -1;
    int index = -1;
    std::from_chars(pointer.data() + list.size(), pointer.data() + pointer.size(), index);
    return index;
}

/// KHR_animation_pointer moves properties other than those of nodes that add_animation() reads.
void say_animated_properties(GltfFile& file, const std::vector<int>& node_of, const Scene& scene) {
    for (const auto& [animation, pointer] : file.animated_properties) {
        const int material = index_in_pointer(pointer, "/materials/"), node = index_in_pointer(pointer, "/nodes/");
        const bool is_material = material >= 0 && size_t(material) < file.model.materials.size();
        const bool is_node = node >= 0 && size_t(node) < node_of.size();
        if (is_node && node_of[size_t(node)] < 0) continue;  // outside the scene that is shown
        const std::string property = pointer.substr(pointer.rfind('/') + 1);
        const bool is_read =
            is_node && pointer == "/nodes/" + std::to_string(node) + "/" + property &&
            (property == "translation" || property == "rotation" || property == "scale" || property == "weights");
        if (is_read) continue;
        const std::string whose = is_material
                                      ? " of material '" + shortened(scene.materials[size_t(material)].name) + "'"
                                  : is_node ? " of node '" + shortened(file.model.nodes[size_t(node)].name) + "'"
                                            : "";
        file.warn("The animation '" + shortened(animation) + "' moves " + shortened(pointer) + whose +
                      " (KHR_animation_pointer), which stays as it is at rest.",
                  is_material ? material : -1, is_node ? node_of[size_t(node)] : -1);
    }
}

/// Paths find which light is kept from a point themselves, so that a baked image of it would darken twice.
void say_occlusion(GltfFile& file, const Scene& scene) {
    std::string names;
    size_t count = 0;
    for (size_t i = 0; i < file.model.materials.size(); ++i) {
        const bool is_drawn = std::ranges::any_of(
            scene.instances, [&](const Instance& instance) { return scene.meshes[instance.mesh].material == i; });
        const auto& texture = file.model.materials[i].occlusionTexture;
        if (!is_drawn || texture.index < 0 || texture.strength == 0.0) continue;
        if (++count <= 3) names += (names.empty() ? "'" : ", '") + shortened(scene.materials[i].name) + "'";
    }
    if (count == 0) return;
    if (count > 3) names += " and " + std::to_string(count - 3) + " more";
    file.warn("Occlusion textures (of " + names +
              ") are left out: the path tracer computes occlusion, and direct light has none.");
}

void say_image_based_light(GltfFile& file) {
    const int shown = std::max(file.model.defaultScene, 0);
    if (size_t(shown) >= file.model.scenes.size()) return;
    if (find_extension(file.model.scenes[size_t(shown)].extensions, "EXT_lights_image_based"))
        file.warn(
            "The scene's light from images (EXT_lights_image_based) is not read: give it as 'environment' in a "
            "scene.json.");
}

/// Blender's exporter writes lux and candela as 683 times its own W/m^2 and W/sr unless told otherwise, and the
/// radiance of emitters as it is (glTF-Blender-IO, blender/exp/lights.py, "lighting mode"); ssrlab reads all of them as
/// W.
void say_blender_units(GltfFile& file, const Scene& scene) {
    const bool is_lit = std::ranges::any_of(
        scene.lights, [](const PunctualLight& light) { return light.intensity != glm::vec3(0.0f); });
    if (!is_lit || !file.model.asset.generator.starts_with("Khronos glTF Blender I/O")) return;
    file.warn(
        "Blender's exporter multiplies punctual lights by 683 lm/W, but not emitters and the world's light, unless "
        "its lighting mode is 'Unitless'; ssrlab reads W/m^2 and W/sr. For Blender's own picture put "
        "\"light_scale\": 0.00146413 (1/683) into a scene.json.");
}
}  // namespace

void say_what_is_left_out(GltfFile& file, const std::vector<int>& node_of, const Scene& scene) {
    say_animated_properties(file, node_of, scene);
    say_occlusion(file, scene);
    say_image_based_light(file);
    say_blender_units(file, scene);
}
