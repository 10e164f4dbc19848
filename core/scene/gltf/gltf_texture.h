#pragma once
#include "core/scene/gltf/gltf_file.h"
#include "core/scene/scene.h"

#include <map>
#include <tuple>

/// Collects the textures that materials ask for: each glTF texture once per use as colour or data, then decodes the
/// images that these show. Images that no texture shows are not touched.
class GltfTextures {
public:
    GltfTextures(GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

    /// Whether later requests are for something drawn; if not, slots are empty.
    void set_drawing(bool is_drawing) { is_drawing_ = is_drawing; }

    /// `info`: the index, texture coordinate set and extensions of a glTF textureInfo. `is_srgb`: used as colour.
    /// The slot's texcoord is the number of the TEXCOORD_n, which may be above 1.
    TextureSlot slot(int texture, int texcoord, const tinygltf::ExtensionMap& extensions, bool is_srgb,
                     const std::string& what);

    /// The same for a texture that nothing is drawn with: empty unless another use has asked for it.
    TextureSlot slot_if_used(int texture, int texcoord, const tinygltf::ExtensionMap& extensions, bool is_srgb,
                             const std::string& what);

    /// Decodes all images on all cores. Fails with Error if one is missing or cannot be decoded.
    void decode();

private:
    /// The images that a texture names, in order of preference: the first that can be read is shown.
    using Candidates = std::vector<size_t>;
    Candidates images_of(const tinygltf::Texture& texture, const std::string& what);

    GltfFile& file_;
    Scene& scene_;
    bool is_drawing_ = true;
    std::map<std::tuple<int, bool>, int> index_of_;  // glTF texture and its use -> index into scene_.textures
    std::vector<Candidates> images_of_;              // per element of scene_.textures
};
