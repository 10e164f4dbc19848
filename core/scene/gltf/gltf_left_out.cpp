#include "core/near_miss.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/gltf_value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

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

/// "v3.4.50" as {3, 4, 50}; what is missing or no number is 0.
std::array<int, 3> version_in(const std::string& generator) {
    std::array<int, 3> version{};
    const size_t at = generator.rfind(" v");
    if (at != generator.npos)
        std::sscanf(generator.c_str() + at, " v%9d.%9d.%9d", &version[0], &version[1], &version[2]);
    return version;
}

/// Blender's exporter writes lux and candela as 683 times its own W/m^2 and W/sr unless told otherwise, and the
/// radiance of emitters as it is (glTF-Blender-IO, blender/exp/lights.py, "lighting mode"). Before 3.4.40 it wrote a
/// sun's W/m^2, and of other lights the W that they send in all directions (blender/exp/gltf2_blender_gather_lights.py
/// there). ssrlab reads W/m^2 and W/sr.
void say_blender_units(GltfFile& file, const Scene& scene) {
    const std::string& generator = file.model.asset.generator;
    if (!generator.starts_with("Khronos glTF Blender I/O")) return;
    size_t suns = 0, others = 0;
    for (const PunctualLight& light : scene.lights)
        if (light.intensity != glm::vec3(0.0f)) ++(light.type == LightType::directional ? suns : others);
    constexpr std::array<int, 3> first_with_photometric_units{3, 4, 40};
    if (version_in(generator) >= first_with_photometric_units) {
        if (suns + others > 0)
            file.warn(
                "Blender's exporter multiplies punctual lights by 683 lm/W, but not emitters and the world's light, "
                "unless its lighting mode is 'Unitless'; ssrlab reads W/m^2 and W/sr. For Blender's own picture put "
                "\"light_scale\": 0.00146413 (1/683) into a scene.json.");
    } else if (others > 0) {
        file.warn(
            "Blender's exporter before 3.4.40 writes the power of point lights and spots in W, which is 4 pi times the "
            "W/sr that ssrlab reads. For Blender's own picture " +
            std::string(suns > 0 ? "export the scene with a newer version, as \"light_scale\" would dim its suns, too."
                                 : "put \"light_scale\": 0.0795775 (1 / (4 pi)) into a scene.json."));
    }
}
}  // namespace

void say_what_is_left_out(GltfFile& file, const std::vector<int>& node_of, const Scene& scene) {
    say_animated_properties(file, node_of, scene);
    say_occlusion(file, scene);
    say_image_based_light(file);
    say_blender_units(file, scene);
}
