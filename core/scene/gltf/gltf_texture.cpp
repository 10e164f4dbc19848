#include "core/scene/gltf/gltf_texture.h"

#include "core/decoded_image.h"
#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/gltf/gltf_uri.h"
#include "core/scene/gltf/gltf_value.h"
#include "core/scene/ranges.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace {
TextureWrap wrap(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp_to_edge;
    return mode == TINYGLTF_TEXTURE_WRAP_REPEAT ? TextureWrap::repeat : TextureWrap::mirrored_repeat;
}

/// KHR_texture_transform: uv' = translation * rotation * scale * uv, the rotation counter-clockwise where v points up.
glm::mat3 texture_transform(const GltfFile& file, const tinygltf::Value& extension, const std::string& what) {
    const glm::vec2 offset = vector_member<2>(file, extension, "offset", glm::vec2(0.0f), what);
    const glm::vec2 scale = vector_member<2>(file, extension, "scale", glm::vec2(1.0f), what);
    const float rotation = number_member(file, extension, "rotation", 0.0f, what);
    for (int i = 0; i < 2; ++i) {
        checked_number(file, offset[i], -any_length, any_length, what + ": 'offset'");
        checked_number(file, scale[i], -any_length, any_length, what + ": 'scale'");
    }
    const float c = std::cos(rotation), s = std::sin(rotation);
    return glm::mat3(c * scale.x, -s * scale.x, 0.0f, s * scale.y, c * scale.y, 0.0f, offset.x, offset.y, 1.0f);
}

/// PNG and JPEG, as glTF 2.0 has it, and WebP (EXT_texture_webp), by the libraries of these formats: Debian's
/// stb_image, which tinygltf calls, inflates a few bytes to gigabytes without a look at the header, and writes outside
/// its memory for some broken JPEGs.
DecodedImage decode_image_of(const GltfFile& file, size_t index) {
    ImageFile image;
    read_image_file(file, index, image);
    const std::string& uri = file.model.images[index].uri;
    return decode_image({image.bytes, image_title(file, index), uri.empty() || is_data_uri(uri) ? "image" : uri},
                        any_texture_side);
}
}  // namespace

TextureSlot GltfTextures::slot(int texture, int texcoord, const tinygltf::ExtensionMap& extensions, bool is_srgb,
                               const std::string& what) {
    TextureSlot slot;
    if (texture < 0 || !is_drawing_) return slot;
    const auto& model = file_.model;
    const auto& source = model.textures[checked_index(file_, texture, model.textures.size(), what + ": texture")];
    const Candidates images = images_of(source, what);
    if (images.empty()) return slot;
    slot.texcoord = unsigned(texcoord);
    if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
        slot.uv_transform = texture_transform(file_, found->second, what);
        const int replacement = index_member(found->second, "texCoord");
        if (replacement >= 0) slot.texcoord = unsigned(replacement);
    }
    const auto [found, is_new] = index_of_.try_emplace({texture, is_srgb}, int(scene_.textures.size()));
    slot.texture = found->second;
    if (!is_new) return slot;

    Texture& added = scene_.textures.emplace_back();
    images_of_.push_back(images);
    const tinygltf::Image& image = model.images[images.front()];
    added.name = !image.uri.empty() && !is_data_uri(image.uri) ? image.uri : image.name;
    added.is_srgb = is_srgb;
    if (source.sampler >= 0) {
        const auto& sampler =
            model.samplers[checked_index(file_, source.sampler, model.samplers.size(), what + ": sampler")];
        added.wrap_u = wrap(sampler.wrapS);
        added.wrap_v = wrap(sampler.wrapT);
        added.is_nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return slot;
}

TextureSlot GltfTextures::slot_if_used(int texture, int texcoord, const tinygltf::ExtensionMap& extensions,
                                       bool is_srgb, const std::string& what) {
    return index_of_.contains({texture, is_srgb}) ? slot(texture, texcoord, extensions, is_srgb, what) : TextureSlot();
}

GltfTextures::Candidates GltfTextures::images_of(const tinygltf::Texture& texture, const std::string& what) {
    const size_t count = file_.model.images.size();
    Candidates images;
    if (const auto webp = texture.extensions.find("EXT_texture_webp"); webp != texture.extensions.end())
        if (const int source = index_member(webp->second, "source"); source >= 0)
            images.push_back(checked_index(file_, source, count, what + ": image"));
    if (texture.source >= 0) images.push_back(checked_index(file_, texture.source, count, what + ": image"));
    // Both are the same picture; the plain one is what readers of all kinds show, unless the file requires the
    // extension.
    const auto& required = file_.model.extensionsRequired;
    if (images.size() == 2 && std::ranges::find(required, "EXT_texture_webp") == required.end())
        std::swap(images[0], images[1]);
    struct Other {
        const char *extension, *kind, *converter;
    };
    const Other others[] = {{"KHR_texture_basisu", "KTX2", "gltf-transform ktxdecompress IN.glb OUT.glb"},
                            {"MSFT_texture_dds", "DDS", "oiiotool IN.dds -o OUT.png"},
                            {"EXT_texture_avif", "AVIF", "gltf-transform png IN.glb OUT.glb"}};
    std::string reason = "the texture names no image";
    for (const auto& [extension, kind, converter] : others) {
        if (!texture.extensions.contains(extension)) continue;
        reason = std::string(kind) + " (" + extension + ") cannot be decoded";
        if (images.empty())
            reason += std::string("; `") + converter + "` makes PNG of it";
        else
            file_.warn("The " + what + " shows the PNG or JPEG that its file has as a fallback, since " + reason + ".");
    }
    if (images.empty()) file_.warn("The " + what + " is ignored, since " + reason + ".");
    return images;
}

void GltfTextures::decode() {
    std::vector<Candidates> shown(images_of_);
    std::ranges::sort(shown);
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    std::vector<DecodedImage> decoded(shown.size());
    std::vector<std::vector<std::string>> warnings(shown.size());
    tbb::parallel_for(size_t(0), shown.size(), [&](size_t i) {
        for (size_t k = 0; k < shown[i].size(); ++k) try {
                decoded[i] = decode_image_of(file_, shown[i][k]);
                for (const std::string& warning : decoded[i].warnings)
                    warnings[i].push_back(image_title(file_, shown[i][k]) + ": " + warning + ".");
                break;
            } catch (const MachineError&) {
                throw;
            } catch (const Error& e) {
                if (k + 1 == shown[i].size()) throw;
                warnings[i].push_back(image_title(file_, shown[i][k + 1]) +
                                      " is shown in place of another: " + e.what() + ".");
            }
    });
    std::vector<Texels> texels;
    for (size_t i = 0; i < shown.size(); ++i) {
        texels.push_back(make_texels(std::move(decoded[i].rgba)));
        scene_.memory.take(decoded[i].memory);
        for (const std::string& warning : warnings[i]) file_.warn(warning);
    }
    for (size_t i = 0; i < scene_.textures.size(); ++i) {
        const size_t image = size_t(std::ranges::lower_bound(shown, images_of_[i]) - shown.begin());
        Texture& texture = scene_.textures[i];
        texture.extent = decoded[image].extent, texture.channel_bytes = decoded[image].channel_bytes;
        texture.rgba = texels[image];
    }
}
