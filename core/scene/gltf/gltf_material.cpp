#include "core/scene/gltf/gltf_material.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/gltf/gltf_drawn.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/ranges.h"
#include "core/scene/texture_slots.h"

#include <algorithm>
#include <cfloat>
#include <cstring>

namespace {
/// What messages call a material: by its name, and by its place where others have that name, too.
std::string label_of(const GltfFile& file, size_t index, const std::string& name) {
    const std::string label = "material '" + shortened(name) + "'";
    const auto& all = file.model.materials;
    const bool is_shared = std::ranges::count(all, all[index].name, &tinygltf::Material::name) > 1;
    return is_shared && !all[index].name.empty() ? label + " (materials[" + std::to_string(index) + "])" : label;
}

/// BLEND is decided by cut_blended_materials(), once textures and vertices are known.
void read_alpha(const MaterialSource& source, Material& material) {
    if (source.gltf.alphaMode == "MASK") material.alpha_mode = AlphaMode::mask;
    material.alpha_cutoff =
        checked_number(source.file, source.gltf.alphaCutoff, 0.0, FLT_MAX, source.what + ": alphaCutoff");
}

Material read_material(GltfFile& file, size_t index, GltfTextures& textures) {
    Material material;
    const tinygltf::Material& gltf = file.model.materials[index];
    material.name = gltf.name.empty() ? "material_" + std::to_string(index) : gltf.name;
    const MaterialSource source{file, gltf, int(index), label_of(file, index, material.name), textures};
    const std::string& what = source.what;
    const auto& pbr = gltf.pbrMetallicRoughness;
    glm::vec4 color = fixed_vector<4>(file, pbr.baseColorFactor, glm::vec4(1.0f), what + ": baseColorFactor");
    for (int i = 0; i < 4; ++i) color[i] = checked_number(file, color[i], 0.0, 1.0, what + ": baseColorFactor");
    material.base_color = color;
    material.alpha = color.a;
    material.metalness = checked_number(file, pbr.metallicFactor, 0.0, 1.0, what + ": metallicFactor");
    material.roughness = checked_number(file, pbr.roughnessFactor, 0.0, 1.0, what + ": roughnessFactor");
    material.emission = fixed_vector<3>(file, gltf.emissiveFactor, glm::vec3(0.0f), what + ": emissiveFactor");
    for (int i = 0; i < 3; ++i)
        checked_number(file, material.emission[i], 0.0, any_radiance, what + ": emissiveFactor");
    material.normal_scale =
        checked_number(file, gltf.normalTexture.scale, -any_length, any_length, what + ": normal scale");
    material.is_double_sided = gltf.doubleSided;
    read_alpha(source, material);

    const bool is_metallic_roughness = !gltf.extensions.contains("KHR_materials_pbrSpecularGlossiness");
    if (is_metallic_roughness) {
        material.base_color_texture = source.slot(pbr.baseColorTexture, true, "base colour");
        material.metalness_roughness_texture = source.slot(pbr.metallicRoughnessTexture, false, "metallic-roughness");
    }
    material.normal_texture = source.slot(gltf.normalTexture, false, "normal");
    const auto& occlusion = gltf.occlusionTexture;  // nothing is drawn with it
    material.occlusion_texture = textures.slot_if_used(occlusion.index, occlusion.texCoord, occlusion.extensions, false,
                                                       "occlusion texture of " + what);
    material.emission_texture = source.slot(gltf.emissiveTexture, true, "emissive");
    read_material_extensions(source, material);
    return material;
}

/// Vertices have two sets of texture coordinates: those of the material's textures, which may have any numbers. Makes
/// its slots name one of the two, and returns the numbers.
std::array<unsigned, 2> choose_uv_sets(GltfFile& file, Material& material, size_t index) {
    const auto slots = texture_slots(material);
    std::vector<unsigned> used;
    for (const TextureSlot* slot : slots)
        if (slot->texture >= 0 && std::ranges::find(used, slot->texcoord) == used.end()) used.push_back(slot->texcoord);
    if (std::ranges::all_of(used, [](unsigned set) { return set < 2; })) return {0, 1};
    used.resize(std::max<size_t>(used.size(), 2), used[0]);
    for (size_t i = 0; i < slots.size(); ++i) {
        if (slots[i]->texture < 0) continue;
        const unsigned set = slots[i]->texcoord;
        slots[i]->texcoord = set == used[1] && set != used[0] ? 1 : 0;
        if (set != used[0] && set != used[1])
            file.warn("The " + std::string(texture_channels[i]) + " texture of " +
                          label_of(file, index, material.name) + " uses TEXCOORD_" + std::to_string(set) +
                          ", a third set of texture coordinates beside TEXCOORD_" + std::to_string(used[0]) +
                          " and TEXCOORD_" + std::to_string(used[1]) + ": TEXCOORD_" + std::to_string(used[0]) +
                          " is used in its place.",
                      int(index));
    }
    material.occlusion_texture.texcoord = 0;
    return {used[0], used[1]};
}

bool has_primitive_without_material(const GltfFile& file) {
    return std::ranges::any_of(file.model.meshes, [](const tinygltf::Mesh& mesh) {
        return std::ranges::any_of(mesh.primitives,
                                   [](const tinygltf::Primitive& primitive) { return primitive.material < 0; });
    });
}

/// Smallest and largest of a texture's alpha; 1 where there is none.
glm::vec2 alpha_of(const Scene& scene, const TextureSlot& slot) {
    if (slot.texture < 0) return glm::vec2(1.0f);
    const Texture& texture = scene.textures[size_t(slot.texture)];
    const std::vector<uint8_t>& bytes = *texture.rgba;
    glm::vec2 range(1.0f, 0.0f);
    for (size_t at = 3 * texture.channel_bytes; at < bytes.size(); at += 4 * texture.channel_bytes) {
        uint16_t code = bytes[at];
        if (texture.channel_bytes == 2) std::memcpy(&code, &bytes[at], sizeof(code));
        const float alpha = float(code) / (texture.channel_bytes == 2 ? 65535.0f : 255.0f);
        range = {std::min(range.x, alpha), std::max(range.y, alpha)};
    }
    return range;
}

/// The same of COLOR_0, over all vertices that have the material.
glm::vec2 vertex_alpha_of(const Scene& scene, size_t material) {
    glm::vec2 range(1.0f, 0.0f);
    for (const Mesh& mesh : scene.meshes)
        if (mesh.material == material)
            for (const Vertex& v : mesh.vertices) range = {std::min(range.x, v.color.a), std::max(range.y, v.color.a)};
    return range.x > range.y ? glm::vec2(1.0f) : range;
}
}  // namespace

void add_materials(GltfFile& file, Scene& scene) {
    GltfTextures textures(file, scene);
    const std::vector<bool> is_drawn = drawn_materials(file);
    for (size_t i = 0; i < file.model.materials.size(); ++i) {
        textures.set_drawing(is_drawn[i]);
        scene.materials.push_back(read_material(file, i, textures));
        file.uv_sets.push_back(choose_uv_sets(file, scene.materials.back(), i));
    }
    if (has_primitive_without_material(file)) scene.materials.push_back({.name = "default"});
    textures.decode();
    make_roughness_textures(file, scene);
}

void cut_blended_materials(GltfFile& file, Scene& scene, const GltfChoices& choices) {
    for (size_t i = 0; i < file.model.materials.size(); ++i) {
        if (file.model.materials[i].alphaMode != "BLEND") continue;
        Material& material = scene.materials[i];
        const glm::vec2 alpha =
            material.alpha * alpha_of(scene, material.base_color_texture) * vertex_alpha_of(scene, i);
        if (alpha.x >= 1.0f) continue;  // opaque, however it is drawn
        const std::string sentence = "The " + label_of(file, i, material.name) + " is blended (alphaMode BLEND) and ";
        if (choices.draws_blended_opaque) {
            file.warn(sentence + "drawn opaque.", int(i));
            continue;
        }
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = 0.5f;
        file.warn(
            sentence + "drawn where its alpha is at least 0.5" +
                (alpha.y < 0.5f ? ", but its alpha is lower everywhere: it is invisible." : ", as if it were a mask."),
            int(i));
    }
}
