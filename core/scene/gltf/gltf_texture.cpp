#include "core/scene/gltf/gltf_texture.h"

#include "core/error.h"
#include "core/jpeg.h"
#include "core/near_miss.h"
#include "core/png.h"
#include "core/scene/gltf/encoded_image.h"
#include "core/scene/gltf/gltf_uri.h"
#include "core/scene/gltf/gltf_value.h"
#include "core/scene/ranges.h"
#include "core/webp.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {
TextureWrap wrap(const GltfFile& file, int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return TextureWrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return TextureWrap::mirrored_repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return TextureWrap::clamp_to_edge;
        default:
            fail(file.name(), ": a sampler has the unknown wrap mode ", mode);
    }
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

struct Decoded {
    glm::uvec2 extent{0, 0};
    Texels rgba;
};

/// PNG and JPEG, as glTF 2.0 has it, and WebP (EXT_texture_webp), by the libraries of these formats: Debian's
/// stb_image, which tinygltf calls, inflates a few bytes to gigabytes without a look at the header, and writes outside
/// its memory for some broken JPEGs. What stays is taken from `kept`.
Decoded decode_image(const GltfFile& file, size_t index, MemoryShare& kept) {
    const std::string what = image_title(file, index);
    ImageFile image;
    read_image_file(file, index, image);
    const std::span<const uint8_t> encoded = image.bytes;
    const auto broken = [&] { fail(what, " cannot be decoded: it is neither an intact PNG nor JPEG nor WebP"); };
    const glm::uvec2 extent = encoded_extent(encoded);
    if (extent.x == 0 || extent.y == 0) broken();
    if (std::max(extent.x, extent.y) > any_texture_side)
        fail(what, " has ", extent.x, " x ", extent.y, " pixels; allowed are sides of ", any_texture_side);
    // Per pixel: of RGBA, and what is there beside it: 16-bit codes of a PNG; planes, coefficients and a copy of a
    // JPEG; pixels and caches of a WebP.
    constexpr double bytes_kept = 4, bytes_of_png = 8, bytes_of_jpeg = 14, bytes_of_webp = 12;
    const double bytes_of_decoder = is_png(encoded) ? bytes_of_png : is_webp(encoded) ? bytes_of_webp : bytes_of_jpeg;
    const double pixels = double(extent.x) * double(extent.y);
    const std::string sized = what + " of " + std::to_string(extent.x) + " x " + std::to_string(extent.y) + " pixels";
    MemoryShare decoder;
    kept.add(pixels * bytes_kept, sized), decoder.add(pixels * bytes_of_decoder, sized);

    auto rgba = is_png(encoded)    ? decode_png_rgba(encoded)
                : is_webp(encoded) ? decode_webp_rgba(encoded, extent)
                                   : decode_jpeg_rgba(encoded, extent);
    if (!rgba) broken();
    return {extent, make_texels(std::move(*rgba))};
}
}  // namespace

TextureSlot GltfTextures::slot(int texture, int texcoord, const tinygltf::ExtensionMap& extensions, bool is_srgb,
                               const std::string& what) {
    TextureSlot slot;
    if (texture < 0) return slot;
    const auto& model = file_.model;
    const auto& source = model.textures[checked_index(file_, texture, model.textures.size(), what + ": texture")];
    const Candidates images = images_of(source, what);
    if (images.empty()) return slot;
    if (texcoord < 0) fail(file_.name(), ": the ", what, " has the negative texCoord ", texcoord);
    slot.texcoord = unsigned(texcoord);
    if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
        slot.uv_transform = texture_transform(file_, found->second, what);
        const int replacement = index_member(file_, found->second, "texCoord", what);
        if (replacement >= 0) slot.texcoord = unsigned(replacement);
    }
    if (slot.texcoord > 1) {
        file_.warn("The " + what + " uses the texture coordinates TEXCOORD_" + std::to_string(slot.texcoord) +
                   ", which are replaced by TEXCOORD_0.");
        slot.texcoord = 0;
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
        added.wrap_u = wrap(file_, sampler.wrapS);
        added.wrap_v = wrap(file_, sampler.wrapT);
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
        if (const int source = index_member(file_, webp->second, "source", what); source >= 0)
            images.push_back(checked_index(file_, source, count, what + ": image"));
    if (texture.source >= 0) images.push_back(checked_index(file_, texture.source, count, what + ": image"));
    if (!images.empty()) return images;
    const std::pair<const char*, const char*> others[] = {
        {"KHR_texture_basisu",
         "KTX2 (KHR_texture_basisu), which ssrlab cannot decode; `gltf-transform ktxdecompress "
         "IN.glb OUT.glb` makes PNG of it"},
        {"MSFT_texture_dds",
         "DDS (MSFT_texture_dds), which ssrlab cannot decode; `oiiotool IN.dds -o OUT.png` makes PNG "
         "of it, which the texture's 'source' may name"},
        {"EXT_texture_avif",
         "AVIF (EXT_texture_avif), which ssrlab cannot decode; `gltf-transform png IN.glb OUT.glb` "
         "makes PNG of it"}};
    std::string reason = "the texture names no image";
    for (const auto& [extension, kind] : others)
        if (texture.extensions.contains(extension)) reason = std::string("its only image is ") + kind;
    file_.warn("The " + what + " is ignored, since " + reason + ".");
    return images;
}

void GltfTextures::decode() {
    std::vector<Candidates> shown(images_of_);
    std::ranges::sort(shown);
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    std::vector<Decoded> decoded(shown.size());
    std::vector<std::string> warnings(shown.size());
    tbb::parallel_for(size_t(0), shown.size(), [&](size_t i) {
        for (size_t k = 0; k < shown[i].size(); ++k) try {
                decoded[i] = decode_image(file_, shown[i][k], scene_.memory);
                break;
            } catch (const MachineError&) {
                throw;
            } catch (const Error& e) {
                if (k + 1 == shown[i].size()) throw;
                warnings[i] = image_title(file_, shown[i][k + 1]) + " is shown in place of another: " + e.what() + ".";
            }
    });
    for (const std::string& warning : warnings)
        if (!warning.empty()) file_.warn(warning);
    for (size_t i = 0; i < scene_.textures.size(); ++i) {
        const Decoded& image = decoded[size_t(std::ranges::lower_bound(shown, images_of_[i]) - shown.begin())];
        scene_.textures[i].extent = image.extent, scene_.textures[i].rgba = image.rgba;
    }
}
