#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/gltf/gltf_material.h"
#include "core/scene/ranges.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cstring>

namespace {
using tinygltf::Value;

const char* const specular_glossiness = "KHR_materials_pbrSpecularGlossiness";

glm::vec3 checked_color(const MaterialSource& source, const Value& extension, const char* key, double max) {
    glm::vec3 color = vector_member<3>(source.file, extension, key, glm::vec3(1.0f), source.what);
    for (int i = 0; i < 3; ++i) color[i] = checked_number(source.file, color[i], 0.0, max, source.what + ": " + key);
    return color;
}

float checked_factor(const MaterialSource& source, const Value& extension, const char* key) {
    return checked_number(source.file, number_member(source.file, extension, key, 1.0f, source.what), 0.0, 1.0,
                          source.what + ": " + key);
}

void read_emissive_strength(const MaterialSource& source, const Value& extension, Material& material) {
    const float factor = number_member(source.file, extension, "emissiveStrength", 1.0f, source.what);
    material.emission *= checked_number(source.file, factor, 0.0, FLT_MAX, source.what + ": emissiveStrength");
    for (int i = 0; i < 3; ++i)
        checked_number(source.file, material.emission[i], 0.0, any_radiance,
                       source.what + ": the product of emissiveFactor and emissiveStrength");
}

void read_specular(const MaterialSource& source, const Value& extension, Material& material) {
    material.specular = checked_factor(source, extension, "specularFactor");
    material.specular_texture = source.slot(extension, "specularTexture", false, "specular");
    material.specular_color = checked_color(source, extension, "specularColorFactor", any_radiance);
    material.specular_color_texture = source.slot(extension, "specularColorTexture", true, "specular colour");
}

/// Of the index of refraction, seen from air; 0 stands for an infinite one, whose reflectance is 1.
void read_ior(const MaterialSource& source, const Value& extension, Material& material) {
    const double ior = checked_number(source.file, number_member(source.file, extension, "ior", 1.5f, source.what), 0.0,
                                      FLT_MAX, source.what + ": ior");
    if (ior == 1.5) return;
    const double amplitude = (ior - 1.0) / (ior + 1.0);
    material.dielectric_f0 = float(amplitude * amplitude);
}

/// The same material in the words of KHR_materials_specular, as that extension's text converts it: a dielectric whose
/// reflectance at normal incidence is the specular colour. Roughness is made of glossiness by
/// make_roughness_textures().
void read_specular_glossiness(const MaterialSource& source, const Value& extension, Material& material) {
    glm::vec4 diffuse = vector_member<4>(source.file, extension, "diffuseFactor", glm::vec4(1.0f), source.what);
    for (int i = 0; i < 4; ++i)
        diffuse[i] = checked_number(source.file, diffuse[i], 0.0, 1.0, source.what + ": diffuseFactor");
    material.base_color = diffuse;
    material.alpha = diffuse.a;
    material.base_color_texture = source.slot(extension, "diffuseTexture", true, "diffuse");
    material.metalness = 0.0f;
    material.roughness = 1.0f - checked_factor(source, extension, "glossinessFactor");
    material.dielectric_f0 = 1.0f;
    material.specular_color = checked_color(source, extension, "specularFactor", 1.0);
    material.specular_color_texture = source.slot(extension, "specularGlossinessTexture", true, "specular-glossiness");
}

/// An extension that is not read, and what the picture lacks where one of its factors is more than 0.
struct LeftOut {
    const char* extension;
    const char* factor;  ///< a number, or an array of them; absent: 0
    const char* sentence;
    bool needs_transmission = false;  ///< it changes nothing of a surface that lets no light through
};

const std::array left_out = {
    LeftOut{"KHR_materials_transmission", "transmissionFactor",
            "transmits light (KHR_materials_transmission) and is drawn opaque."},
    LeftOut{"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor",
            "scatters light through itself (KHR_materials_diffuse_transmission) and is drawn opaque."},
    LeftOut{"KHR_materials_volume", "thicknessFactor",
            "has a volume (KHR_materials_volume), which is left out: nothing is bent or absorbed inside.", true},
    LeftOut{"KHR_materials_dispersion", "dispersion",
            "disperses light (KHR_materials_dispersion), which is left out: no colours part.", true},
    LeftOut{"KHR_materials_clearcoat", "clearcoatFactor",
            "has a clear coat (KHR_materials_clearcoat), which is left out, and so is all that the coat reflects."},
    LeftOut{"KHR_materials_sheen", "sheenColorFactor",
            "has a sheen (KHR_materials_sheen), which is left out: its rims are too dark."},
    LeftOut{"KHR_materials_iridescence", "iridescenceFactor",
            "is iridescent (KHR_materials_iridescence), which is left out: its reflections lack those colours."},
    LeftOut{"KHR_materials_anisotropy", "anisotropyStrength",
            "is anisotropic (KHR_materials_anisotropy), which is left out: its reflections are round, not stretched."},
};

bool is_more_than_zero(const Value& extension, const char* key) {
    if (!extension.Has(key)) return false;
    const Value& value = extension.Get(key);
    if (value.IsNumber()) return value.GetNumberAsDouble() > 0.0;
    for (int i = 0; i < int(value.ArrayLen()); ++i)
        if (value.Get(i).GetNumberAsDouble() > 0.0) return true;
    return false;
}

void say_left_out_parts(const MaterialSource& source) {
    const auto& extensions = source.gltf.extensions;
    const auto has = [&](const char* name, const char* factor) {
        const Value* extension = find_extension(extensions, name);
        return extension && is_more_than_zero(*extension, factor);
    };
    const bool transmits = has("KHR_materials_transmission", "transmissionFactor") ||
                           has("KHR_materials_diffuse_transmission", "diffuseTransmissionFactor");
    for (const LeftOut& part : left_out)
        if (has(part.extension, part.factor) && (transmits || !part.needs_transmission)) source.warn(part.sentence);
}

/// Roughness as G, of which materials read it: 1 - glossiness * A, in codes of the type To. 1 elsewhere.
template <class From, class To>
std::vector<uint8_t> roughness_codes(const std::vector<uint8_t>& rgba, double glossiness) {
    constexpr double most = std::numeric_limits<To>::max(), most_before = std::numeric_limits<From>::max();
    const size_t texels = rgba.size() / (4 * sizeof(From));
    std::vector<uint8_t> made(texels * 4 * sizeof(To), 255);
    for (size_t i = 0; i < texels; ++i) {
        From alpha;
        std::memcpy(&alpha, &rgba[(4 * i + 3) * sizeof(From)], sizeof(From));
        const To code = To(std::lround(most * (1.0 - glossiness * alpha / most_before)));
        std::memcpy(&made[(4 * i + 1) * sizeof(To)], &code, sizeof(To));
    }
    return made;
}

/// In 16 bits, unless the file's 8 bits hold all of it.
Texels roughness_texels(const Texture& source, float glossiness) {
    const std::vector<uint8_t>& rgba = *source.rgba;
    return make_texels(source.channel_bytes == 2 ? roughness_codes<uint16_t, uint16_t>(rgba, glossiness)
                       : glossiness == 1.0f      ? roughness_codes<uint8_t, uint8_t>(rgba, glossiness)
                                                 : roughness_codes<uint8_t, uint16_t>(rgba, glossiness));
}
}  // namespace

TextureSlot MaterialSource::slot(const Value& extension, const char* key, bool is_srgb, const char* channel) const {
    if (!extension.Has(key)) return {};
    const Value& info = extension.Get(key);
    return textures.slot(index_member(info, "index"), std::max(index_member(info, "texCoord"), 0),
                         info.Has("extensions") ? info.Get("extensions").Get<Value::Object>() : Value::Object(),
                         is_srgb, std::string(channel) + " texture of " + what);
}

void read_material_extensions(const MaterialSource& source, Material& material) {
    const auto& extensions = source.gltf.extensions;
    const auto read = [&](const char* name, const auto& reader) {
        if (const Value* extension = find_extension(extensions, name)) reader(source, *extension, material);
    };
    read("KHR_materials_emissive_strength", read_emissive_strength);
    if (extensions.contains(specular_glossiness)) {
        read(specular_glossiness, read_specular_glossiness);
    } else {
        read("KHR_materials_ior", read_ior);
        read("KHR_materials_specular", read_specular);
    }
    material.is_unlit = extensions.contains("KHR_materials_unlit");
    if (!material.is_unlit) say_left_out_parts(source);
}

void make_roughness_textures(const GltfFile& file, Scene& scene) {
    std::map<std::pair<const void*, float>, Texels> made;  // by the file's texels and the factor
    for (size_t i = 0; i < file.model.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (!find_extension(file.model.materials[i].extensions, specular_glossiness) ||
            material.specular_color_texture.texture < 0)
            continue;
        Texture texture = scene.textures[size_t(material.specular_color_texture.texture)];
        const float glossiness = 1.0f - material.roughness;
        Texels& texels = made[{texture.rgba.get(), glossiness}];
        if (!texels) {
            scene.memory.add(2.0 * double(texture.rgba->size()),
                             file.name() + ": roughness made of texture '" + shortened(texture.name) + "'");
            texels = roughness_texels(texture, glossiness);
        }
        texture.channel_bytes = unsigned(texels->size() / (4 * size_t(texture.extent.x) * texture.extent.y));
        texture.rgba = texels;
        texture.is_srgb = false;
        material.roughness = 1.0f;
        material.metalness_roughness_texture = material.specular_color_texture;
        material.metalness_roughness_texture.texture = int(scene.textures.size());
        scene.textures.push_back(std::move(texture));
    }
}
