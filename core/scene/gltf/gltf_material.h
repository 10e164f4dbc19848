#pragma once
#include "core/scene/gltf/gltf_texture.h"
#include "core/scene/gltf/gltf_value.h"

/// A material while it is read: where from, and where to.
struct MaterialSource {
    GltfFile& file;
    const tinygltf::Material& gltf;
    int index;         ///< in the file, and in Scene::materials
    std::string what;  ///< "material 'glass'", as messages call it
    GltfTextures& textures;

    /// "The material 'glass' " and the rest of the sentence.
    void warn(const std::string& rest) const { file.warn("The " + what + " " + rest, index); }

    /// Of a textureInfo. `channel`: such as "base colour".
    template <class Info>
    TextureSlot slot(const Info& info, bool is_srgb, const char* channel) const {
        return textures.slot(info.index, info.texCoord, info.extensions, is_srgb,
                             std::string(channel) + " texture of " + what);
    }
    /// Of the textureInfo that an extension has under `key`; empty if it has none.
    TextureSlot slot(const tinygltf::Value& extension, const char* key, bool is_srgb, const char* channel) const;
};

/// Reads what extensions say of the material, and says what of it is left out and changes the picture.
void read_material_extensions(const MaterialSource& source, Material& material);

/// Textures of roughness that glTF has as glossiness: made of the file's, once these are decoded.
void make_roughness_textures(const GltfFile& file, Scene& scene);
