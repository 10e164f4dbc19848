#pragma once
#include "core/scene/gltf/gltf_texture.h"
#include "core/scene/gltf/gltf_value.h"

/// A material while it is read: its source and its place in the scene.
struct MaterialSource {
    GltfFile& file;
    const tinygltf::Material& gltf;
    int index;         ///< in the file, and in Scene::materials
    std::string what;  ///< "material 'glass'", as messages call it
    GltfTextures& textures;

    /// "The material 'glass' " and the rest of the sentence.
    void warn(const std::string& rest) const { file.warn("The " + what + " " + rest, index); }

    /// The slot of a textureInfo. `channel`: such as "base colour".
    template <class Info>
    TextureSlot slot(const Info& info, bool is_srgb, const char* channel) const {
        return textures.slot(info.index, info.texCoord, info.extensions, is_srgb,
                             std::string(channel) + " texture of " + what);
    }
    /// The slot of an extension's textureInfo under `key`; empty without one.
    TextureSlot slot(const tinygltf::Value& extension, const char* key, bool is_srgb, const char* channel) const;
};

/// Reads the material's extensions, and warns of ignored ones that change the picture.
void read_material_extensions(const MaterialSource& source, Material& material);

/// Makes roughness textures from the file's glossiness textures, once these are decoded.
void make_roughness_textures(const GltfFile& file, Scene& scene);
