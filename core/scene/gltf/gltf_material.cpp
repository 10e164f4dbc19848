#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/gltf_texture.h"
#include "core/scene/gltf/gltf_value.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/ranges.h"

#include <algorithm>
#include <cfloat>

namespace {
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

void read_alpha(GltfFile& file, const tinygltf::Material& source, const std::string& what, Material& material) {
    if (source.alphaMode == "MASK")
        material.alpha_mode = AlphaMode::mask;
    else if (source.alphaMode == "BLEND")
        file.warn("The " + what + " is blended (alphaMode BLEND) and drawn opaque.");
    else if (source.alphaMode != "OPAQUE")
        fail(file.name(), ": ", what, " has the unknown alphaMode '", source.alphaMode,
             "'; allowed are OPAQUE, MASK and BLEND");
    material.alpha_cutoff = checked_number(file, source.alphaCutoff, 0.0, FLT_MAX, what + ": alphaCutoff");
}

void read_extensions(GltfFile& file, const tinygltf::Material& source, const std::string& what, Material& material) {
    if (const auto* strength = find_extension(source.extensions, "KHR_materials_emissive_strength")) {
        const float factor = number_member(file, *strength, "emissiveStrength", 1.0f, what);
        material.emission *= checked_number(file, factor, 0.0, FLT_MAX, what + ": emissiveStrength");
        for (int i = 0; i < 3; ++i)
            checked_number(file, material.emission[i], 0.0, any_radiance,
                           what + ": the product of emissiveFactor and emissiveStrength");
    }
    if (const auto* specular = find_extension(source.extensions, "KHR_materials_specular")) {
        const float factor = number_member(file, *specular, "specularFactor", 1.0f, what);
        material.specular = checked_number(file, factor, 0.0, 1.0, what + ": specularFactor");
        for (const char* key : {"specularTexture", "specularColorFactor", "specularColorTexture"})
            if (specular->IsObject() && specular->Has(key))
                file.warn("The " + what + " has a " + key + " (KHR_materials_specular), which is ignored.");
    }
    material.is_unlit = source.extensions.contains("KHR_materials_unlit");
    if (const auto* transmission = find_extension(source.extensions, "KHR_materials_transmission"))
        if (number_member(file, *transmission, "transmissionFactor", 0.0f, what) > 0.0f)
            file.warn("The " + what + " transmits light (KHR_materials_transmission) and is drawn opaque.");
}

Material read_material(GltfFile& file, const tinygltf::Material& source, size_t index, GltfTextures& textures) {
    Material material;
    material.name = source.name.empty() ? "material_" + std::to_string(index) : source.name;
    const std::string what = "material '" + shortened(material.name) + "'";
    const auto& pbr = source.pbrMetallicRoughness;
    const glm::vec4 color = fixed_vector<4>(file, pbr.baseColorFactor, glm::vec4(1.0f), what + ": baseColorFactor");
    for (int i = 0; i < 4; ++i) checked_number(file, color[i], 0.0, 1.0, what + ": baseColorFactor");
    material.base_color = color;
    material.alpha = color.a;
    material.metalness = checked_number(file, pbr.metallicFactor, 0.0, 1.0, what + ": metallicFactor");
    material.roughness = checked_number(file, pbr.roughnessFactor, 0.0, 1.0, what + ": roughnessFactor");
    material.emission = fixed_vector<3>(file, source.emissiveFactor, glm::vec3(0.0f), what + ": emissiveFactor");
    for (int i = 0; i < 3; ++i)
        checked_number(file, material.emission[i], 0.0, any_radiance, what + ": emissiveFactor");
    material.normal_scale =
        checked_number(file, source.normalTexture.scale, -any_length, any_length, what + ": normal scale");
    material.is_double_sided = source.doubleSided;
    read_alpha(file, source, what, material);
    read_extensions(file, source, what, material);

    const auto slot = [&](const auto& info, bool is_srgb, const char* channel) {
        return textures.slot(info.index, info.texCoord, info.extensions, is_srgb,
                             std::string(channel) + " texture of " + what);
    };
    material.base_color_texture = slot(pbr.baseColorTexture, true, "base colour");
    material.metalness_roughness_texture = slot(pbr.metallicRoughnessTexture, false, "metallic-roughness");
    material.normal_texture = slot(source.normalTexture, false, "normal");
    const auto& occlusion = source.occlusionTexture;  // nothing is drawn with it
    material.occlusion_texture = textures.slot_if_used(occlusion.index, occlusion.texCoord, occlusion.extensions, false,
                                                       "occlusion texture of " + what);
    material.emission_texture = slot(source.emissiveTexture, true, "emissive");
    return material;
}

bool has_primitive_without_material(const GltfFile& file) {
    return std::ranges::any_of(file.model.meshes, [](const tinygltf::Mesh& mesh) {
        return std::ranges::any_of(mesh.primitives,
                                   [](const tinygltf::Primitive& primitive) { return primitive.material < 0; });
    });
}
}  // namespace

void add_materials(GltfFile& file, Scene& scene) {
    GltfTextures textures(file, scene);
    for (size_t i = 0; i < file.model.materials.size(); ++i)
        scene.materials.push_back(read_material(file, file.model.materials[i], i, textures));
    if (has_primitive_without_material(file)) scene.materials.push_back({.name = "default"});
    textures.decode();
}
