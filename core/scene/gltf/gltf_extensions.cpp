#include "core/scene/gltf/gltf_extensions.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <map>

namespace {
using nlohmann::json;

const std::set<std::string> extensions_read = {"EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                               "EXT_texture_webp",        "KHR_draco_mesh_compression",
                                               "KHR_lights_punctual",     "KHR_materials_emissive_strength",
                                               "KHR_materials_ior",       "KHR_materials_pbrSpecularGlossiness",
                                               "KHR_materials_specular",  "KHR_materials_unlit",
                                               "KHR_materials_variants",  "KHR_mesh_quantization",
                                               "KHR_meshopt_compression", "KHR_node_visibility",
                                               "KHR_texture_transform"};

/// Drawn as if the extension were absent; where that changes what is seen, the part that carries it says so in a
/// warning of its own.
const std::set<std::string> reported_by_their_part = {"EXT_lights_image_based",   "EXT_texture_avif",
                                                      "KHR_animation_pointer",    "KHR_materials_anisotropy",
                                                      "KHR_materials_clearcoat",  "KHR_materials_diffuse_transmission",
                                                      "KHR_materials_dispersion", "KHR_materials_iridescence",
                                                      "KHR_materials_sheen",      "KHR_materials_transmission",
                                                      "KHR_materials_volume",     "KHR_texture_basisu",
                                                      "MSFT_texture_dds"};

/// Where these stand, nothing that is drawn changes: descriptions, sounds, behaviour, and levels of detail beside the
/// finest, which is what the node shows.
const std::set<std::string> harmless_extensions = {"KHR_xmp",
                                                   "KHR_xmp_json_ld",
                                                   "KHR_audio",
                                                   "KHR_audio_emitter",
                                                   "KHR_interactivity",
                                                   "MSFT_lod",
                                                   "MSFT_screencoverage",
                                                   "MSFT_audio_emitter",
                                                   "EXT_mesh_features",
                                                   "EXT_instance_features",
                                                   "MSFT_packing_normalRoughnessMetallic",
                                                   "MSFT_packing_occlusionRoughnessMetallic",
                                                   "EXT_structural_metadata",
                                                   "KHR_implicit_shapes",
                                                   "KHR_physics_rigid_bodies",
                                                   "KHR_node_selectability",
                                                   "KHR_node_hoverability",
                                                   "EXT_mesh_manifold",
                                                   "EXT_mesh_primitive_restart",
                                                   "CESIUM_primitive_outline",
                                                   "FB_geometry_metadata"};

/// Beginnings of the names of extensions that describe things of one program.
const std::vector<std::string> harmless_vendors = {"OMI_", "VRM",     "VRMC_",  "MOZ_",
                                                   "AGI_", "NEEDLE_", "GODOT_", "UNITY_"};

/// Commands that write a file without the extension.
const std::map<std::string, std::string> converters = {
    {"KHR_texture_basisu", "gltf-transform ktxdecompress IN.glb OUT.glb"},
    {"EXT_texture_avif", "gltf-transform png IN.glb OUT.glb"},
};

bool is_harmless(const std::string& extension) {
    return harmless_extensions.contains(extension) ||
           std::ranges::any_of(harmless_vendors,
                               [&](const std::string& vendor) { return extension.starts_with(vendor); });
}

bool is_passed_by(const std::string& extension) {
    return !extensions_read.contains(extension) && !reported_by_their_part.contains(extension) &&
           !is_harmless(extension);
}

/// Adds the extensions that `part`, or a part in it, has and that are passed by.
void find_passed_by(const json& part, std::set<std::string>& found) {
    if (part.is_array()) {
        for (const json& element : part) find_passed_by(element, found);
    } else if (part.is_object()) {
        for (const auto& [key, value] : part.items()) {
            if (key == "extras") continue;
            if (key == "extensions" && value.is_object())
                for (const auto& [extension, content] : value.items())
                    if (is_passed_by(extension)) found.insert(extension);
            find_passed_by(value, found);
        }
    }
}

/// "node 'a'", or "12 nodes ('a', 'b', 'c', ...)".
std::string list_of_parts(const std::vector<std::string>& names, const std::string& kind) {
    if (names.size() == 1) return kind + " " + names.front();
    std::string list;
    constexpr size_t most = 3;
    for (size_t i = 0; i < std::min(names.size(), most); ++i) list += (i ? ", " : "") + names[i];
    const std::string plural = kind == "mesh" ? "meshes" : kind + "s";
    return std::to_string(names.size()) + " " + plural + " (" + list + (names.size() > most ? ", ..." : "") + ")";
}
}  // namespace

void check_required_extensions(const json& root, const std::string& file) {
    for (const std::string& extension : root.value("extensionsRequired", std::set<std::string>())) {
        if (extensions_read.contains(extension) || is_harmless(extension) || extension == "KHR_materials_transmission")
            continue;
        const auto converter = converters.find(extension);
        fail(file, " requires the glTF extension ", shortened(extension), ", which ssrlab does not support",
             converter == converters.end() ? "" : "; `" + converter->second + "` writes a file that does without it");
    }
}

void warn_of_extensions(const json& root, GltfFile& file) {
    // What the root, the asset and the bytes have of an extension takes effect where another part refers to it.
    const std::pair<const char*, const char*> lists[] = {
        {"materials", "material"}, {"meshes", "mesh"},          {"nodes", "node"},   {"textures", "texture"},
        {"cameras", "camera"},     {"animations", "animation"}, {"scenes", "scene"}, {"skins", "skin"},
        {"images", "image"},       {"samplers", "sampler"}};
    for (const auto& [key, kind] : lists) {
        if (!root.contains(key)) continue;
        const bool is_material = kind == std::string("material");
        std::map<std::string, std::vector<std::string>> names_by_extension;
        for (size_t i = 0; i < root[key].size(); ++i) {
            const json& part = root[key][i];
            const std::string name = part.value("name", ""), number = std::to_string(i);
            const std::string title = !name.empty() ? "'" + shortened(name) + "'"
                                      : is_material ? "'material_" + number + "'"
                                                    : number;
            std::set<std::string> found;
            find_passed_by(part, found);
            for (const std::string& extension : found)
                if (is_material)
                    file.warn("The glTF extension " + shortened(extension) + " of material " + title + " is ignored.",
                              int(i));
                else
                    names_by_extension[extension].push_back(title);
        }
        for (const auto& [extension, names] : names_by_extension)
            file.warn("The glTF extension " + shortened(extension) + " of " + list_of_parts(names, kind) +
                      " is ignored.");
    }
}
